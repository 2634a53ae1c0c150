// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace pdsm::test {

/// A grid of an OpenVDB file that a test writes.
struct VdbGrid {
  enum class Kind { density, doubles, frustum, level_set };
  struct Voxel {
    std::array<int, 3> at{};
    float value = 0;
  };

  std::string name = "density";
  Kind kind = Kind::density;
  std::vector<Voxel> voxels;  ///< of a density
  float background = 0;
  double voxel_size = 1;                                                ///< the file's units
  std::array<double, 3> move{};                                         ///< of the file's space, after that
  std::array<std::array<int, 3>, 2> filled{{{0, 0, 0}, {-1, -1, -1}}};  ///< first and last of a box of 1
  double radius = 0;  ///< voxels: of a level set, a ball about the origin
};

/// Writes an OpenVDB file.
void write_vdb(const std::filesystem::path& path, const std::vector<VdbGrid>& grids);

}  // namespace pdsm::test
