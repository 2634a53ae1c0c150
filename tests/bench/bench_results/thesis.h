// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

/// The tables of Saint-Amour, "Penumbra Deep Shadow Maps", master's thesis, 2004, as they stand there. Two
/// Xeon 2.4 GHz, the Stanford dragon, except where said.
namespace pdsm::bench::thesis {

inline constexpr std::array<std::uint32_t, 5> kSamples{4, 16, 36, 64, 256};
inline constexpr std::array<double, 4> kEpsilons{0, 0.02, 0.05, 0.1};
inline constexpr std::array<std::uint32_t, 3> kResolutions{256, 512, 1024};
inline constexpr std::array<std::uint32_t, 5> kMapResolutions{128, 256, 512, 1024, 2048};
inline constexpr std::array<std::uint32_t, 6> kLightSizes{1, 2, 3, 4, 5, 6};

/// Table 3.1, MB by samples and epsilon.
inline constexpr double kDragonSizes[5][4] = {{4.6, 4.6, 1.6, 1.3},
                                              {9.1, 5.3, 1.6, 1.3},
                                              {12.1, 5.5, 1.8, 1.4},
                                              {15.2, 5.6, 1.9, 1.4},
                                              {28.0, 5.1, 1.9, 1.4}};
/// Table 3.2, the scene Nature.
inline constexpr double kNatureSizes[5][4] = {{16.3, 12.2, 5.1, 4.9},
                                              {36.8, 15.8, 5.3, 4.9},
                                              {47.0, 16.2, 5.4, 5.1},
                                              {60.6, 16.4, 5.5, 5.2},
                                              {103.9, 16.2, 5.5, 5.2}};
/// Table 3.3, seconds by samples and resolution, sample maps 512 x 512. The first is "< 1".
inline constexpr double kTimes[5][3] = {{1, 2, 9}, {3, 10, 37}, {6, 21, 77}, {11, 37, 133}, {43, 147, 529}};
/// Table 3.4, seconds by resolution of the sample maps; 512 x 512, 256 samples.
inline constexpr double kMapTimes[5] = {55, 72, 147, 217, 554};
/// Table 3.5, seconds by light size; 512 x 512, 256 samples.
inline constexpr double kLightTimes[6] = {67, 88, 109, 137, 146, 162};
/// Table 3.6, MB of memory, as a whole and in strips of 128 rows.
inline constexpr double kMemory[5][2] = {{19, 6}, {57, 17}, {125, 35}, {208, 59}, {558, 126}};
/// Table 3.7, seconds of the same.
inline constexpr double kMemoryTimes[5][2] = {
    {6.3, 6.9}, {16.7, 17.3}, {34.6, 39.9}, {63.7, 65.3}, {325.3, 259.8}};
/// Table 3.8, seconds on one and two processors, 512 x 512.
inline constexpr double kThreadTimes[5][2] = {{5, 2}, {30, 10}, {43, 21}, {76, 37}, {293, 147}};
/// Table 4.1, frames a second: Sphere and Plant, by software and on a GeForce 6800 GT, unfiltered and
/// bilinear.
inline constexpr double kFrames[2][4] = {{2.7, 0.9, 72.3, 24.5}, {1.9, 0.6, 53.0, 18.3}};

}  // namespace pdsm::bench::thesis
