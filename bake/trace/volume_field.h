// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "trace/light_space.h"
#include "walk/map_grid.h"

namespace pdsm {

/// A part of a ray, begin < end in how often its direction counts, and its optical depth: -log of the share
/// of light that it keeps.
struct MarchedPart {
  double begin = 0, end = 0, optical_depth = 0;
};

/// A volume's density as rays march through it: in blocks of 8 x 8 x 8 cells, each with all of its cells'
/// corners. Any thread.
class VolumeField {
 public:
  explicit VolumeField(const LightSpaceVolume& volume);

  /// Appends the parts of a ray between `begin` and `end` where there is density, in order: of a few voxels
  /// where it is thin, of less than one where it is dense. Each has the density at the share `at`, 0 .. 1, of
  /// its length: the mean over all of these is exact.
  void march(const CentralRay& ray, double begin, double end, double at,
             std::vector<MarchedPart>& parts) const;

  /// Optical depth of a part at its block's greatest density, while its length in voxels is within these.
  static constexpr double kPartDepth = 0.1, kShortestPart = 0.25, kLongestPart = 4;

 private:
  static constexpr int kEdge = DensityBrick::kEdge, kCorners = kEdge + 1;
  struct Block {
    std::array<float, kCorners * kCorners * kCorners> corner{};
    float most = 0;

    [[nodiscard]] float at(const glm::vec3& p) const;
  };

  class March;
  void fill(const DensityGrid& grid);
  [[nodiscard]] std::size_t index(const glm::ivec3& block) const;

  glm::dmat4 light_to_index_;
  double extinction_;
  glm::ivec3 low_{0}, blocks_{0};     ///< first lattice point, and blocks along each axis
  std::vector<std::int32_t> places_;  ///< of each block in block_, or -1
  std::vector<Block> block_;
};

}  // namespace pdsm
