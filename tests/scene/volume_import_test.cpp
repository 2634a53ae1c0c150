// SPDX-License-Identifier: Apache-2.0
// Grids of OpenVDB files as volumes, and the ways in which they can be wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "scene_folder.h"
#include "vdb_files.h"

namespace pdsm::test {
namespace {

std::string volume_of(const std::string& more_fields = "") {
  return R"({"volumes": [{"file": "a.vdb")" + (more_fields.empty() ? "" : ", " + more_fields) + "}]}";
}

class VolumeImport : public testing::Test {
 protected:
  void write(const std::vector<VdbGrid>& grids) const { write_vdb(folder_.path() / "a.vdb", grids); }
  void write(const VdbGrid& grid) const { write(std::vector<VdbGrid>{grid}); }
  [[nodiscard]] std::string fault(const std::string& more_fields = "") const {
    return folder_.fault_of(volume_of(more_fields));
  }
  [[nodiscard]] Scene read(const std::string& more_fields = "") const {
    return folder_.read(volume_of(more_fields));
  }

  const SceneFolder folder_;
};

VdbGrid one_voxel(float value) {
  VdbGrid grid;
  grid.voxels = {{{1, 2, 3}, value}};
  return grid;
}

TEST_F(VolumeImport, VoxelsLieInBricksInOrder) {
  VdbGrid grid;
  grid.voxels = {{{9, 0, 0}, 3}, {{-1, 0, 9}, 2}, {{0, 1, 2}, 1}};
  write(grid);
  const Scene scene = read();
  ASSERT_EQ(scene.volumes.size(), 1U);
  EXPECT_EQ(scene.volumes[0].name, "a.vdb:density");
  const std::vector<DensityBrick>& bricks = scene.volumes[0].grid->bricks;
  ASSERT_EQ(bricks.size(), 3U);
  EXPECT_EQ(bricks[0].first, glm::ivec3(0, 0, 0));
  EXPECT_EQ(bricks[0].density[DensityBrick::at(0, 1, 2)], 1);
  EXPECT_EQ(bricks[1].first, glm::ivec3(8, 0, 0));
  EXPECT_EQ(bricks[1].density[DensityBrick::at(1, 0, 0)], 3);
  EXPECT_EQ(bricks[2].first, glm::ivec3(-8, 0, 8));
  EXPECT_EQ(bricks[2].density[DensityBrick::at(7, 0, 1)], 2);
  EXPECT_EQ(scene.files.size(), 2U);
}

TEST_F(VolumeImport, TheFilesTransformComesBeforeThePlacement) {
  VdbGrid grid = one_voxel(1);
  grid.voxel_size = 0.5;
  grid.move = {1, 0, 0};
  write(grid);
  const Scene scene = read(
      R"("scale": [2, 1, 1], "rotate": [0, 0, 90], "translate": [0, 0, 5], "extinction": 3, "casts": false)");
  ASSERT_EQ(scene.volumes.size(), 1U);
  const Volume& volume = scene.volumes[0];
  // (4, 2, 2) -> (3, 1, 1) in the file -> (6, 1, 1) scaled -> (-1, 6, 1) turned.
  const glm::dvec4 placed = volume.index_to_world * glm::dvec4(4, 2, 2, 1);
  EXPECT_NEAR(glm::length(placed - glm::dvec4(-1, 6, 6, 1)), 0, 1e-12);
  EXPECT_EQ(volume.extinction, 3);
  EXPECT_FALSE(volume.casts);
}

TEST_F(VolumeImport, FilledTilesAreBricks) {
  VdbGrid grid;
  grid.filled = {{{0, 0, 0}, {127, 15, 127}}};
  write(grid);
  const Scene scene = read();
  ASSERT_EQ(scene.volumes.size(), 1U);
  ASSERT_EQ(scene.volumes[0].grid->bricks.size(), 16U * 2 * 16);
  for (const DensityBrick& brick : scene.volumes[0].grid->bricks)
    for (const float density : brick.density) ASSERT_EQ(density, 1);
}

TEST_F(VolumeImport, EmptyGridsAreTold) {
  write(one_voxel(0));
  const Scene scene = read();
  EXPECT_TRUE(scene.volumes.empty());
  EXPECT_EQ(scene.warnings, std::vector<std::string>{"a.vdb:density: is empty, and casts nothing"});
}

TEST_F(VolumeImport, GridsThatAreNotThere) {
  VdbGrid fire = one_voxel(1);
  fire.name = "fire";
  write({one_voxel(1), fire});
  EXPECT_EQ(fault(R"("grid": "fire")"), "");
  EXPECT_EQ(fault(R"("grid": "smoke")"),
            R"(level.scene.json:volumes[0].file: a.vdb: no grid "smoke"; it has "density", "fire")");
}

TEST_F(VolumeImport, DensitiesThatAreNone) {
  const std::string where = "level.scene.json:volumes[0].file: a.vdb: density: ";
  write(one_voxel(-1));
  EXPECT_EQ(fault(), where + "has negative densities");
  write(one_voxel(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_EQ(fault(), where + "has densities that are NaN");
  write(one_voxel(std::numeric_limits<float>::infinity()));
  EXPECT_EQ(fault(), where + "has infinite densities");
}

TEST_F(VolumeImport, GridsThatAreNoDensities) {
  const std::string where = "level.scene.json:volumes[0].file: a.vdb: density: ";
  VdbGrid grid = one_voxel(1);
  grid.background = 0.5;
  write(grid);
  EXPECT_EQ(fault(), where + "has a density of its own outside of its voxels");
  grid.kind = VdbGrid::Kind::frustum;
  write(grid);
  EXPECT_EQ(fault(), where + "has a frustum's transform: must be affine");
  grid.kind = VdbGrid::Kind::doubles;
  write(grid);
  EXPECT_EQ(fault(), where + "must be a grid of floats, is one of double");
}

TEST_F(VolumeImport, SizesThatNothingCanHold) {
  VdbGrid grid;
  grid.filled = {{{0, 0, 0}, {4095, 4095, 4095}}};
  write(grid);
  EXPECT_EQ(
      fault(),
      "level.scene.json:volumes[0].file: a.vdb: density: has more than 1048576 bricks of 8 x 8 x 8 voxels");
  grid = one_voxel(1);
  grid.voxels.push_back({{1 << 21, 1 << 21, 1 << 21}, 1});
  write(grid);
  EXPECT_EQ(fault(), "level.scene.json:volumes[0].file: a.vdb:density:grid: spans too many voxels");
}

TEST_F(VolumeImport, FilesThatAreNoOpenVdb) {
  const std::string where = "level.scene.json:volumes[0].file: a.vdb: ";
  EXPECT_EQ(fault(), where + "no such file");
  folder_.write("a.vdb", "smoke");
  EXPECT_EQ(fault().substr(0, where.size() + 29), where + "is no OpenVDB file that can b");
}

TEST_F(VolumeImport, TruncatedFilesAreRefused) {
  write(one_voxel(1));
  std::ifstream stream(folder_.path() / "a.vdb", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  ASSERT_EQ(fault(), "");
  for (std::size_t size = 0; size + 1 < whole.size(); size += 1 + whole.size() / 60) {
    folder_.write("a.vdb", whole.substr(0, size));
    EXPECT_NE(fault(), "") << size;
  }
}

TEST_F(VolumeImport, FieldsOfTheEntry) {
  write(one_voxel(1));
  const std::string where = "level.scene.json:volumes[0].";
  EXPECT_EQ(fault(R"("extinction": -1)"), where + "extinction: must be a number >= 0");
  EXPECT_EQ(fault(R"("scale": 0)"), where + "scale: must be a number or [x,y,z], not 0");
  EXPECT_EQ(fault(R"("grid": 3)"), where + "grid: must be a string");
  EXPECT_EQ(folder_.fault_of(R"({"volumes": [{}]})"), where + "file: is missing");
}

double volume_of(const Geometry& geometry) {
  double sum = 0;
  const auto at = [&](std::uint32_t n) {
    return glm::dvec3(geometry.local_to_world * glm::dvec4(glm::dvec3(geometry.mesh->positions[n]), 1.0));
  };
  for (const glm::uvec3& t : geometry.mesh->triangles)
    sum += glm::dot(at(t.x), glm::cross(at(t.y), at(t.z))) / 6;
  return sum;
}

TEST_F(VolumeImport, LevelSetsAreSolids) {
  VdbGrid grid;
  grid.kind = VdbGrid::Kind::level_set;
  grid.radius = 12;
  grid.voxel_size = 0.25;
  write(grid);
  // A polyhedron about a ball of radius 3: within a voxel of its volume, and turned right in a mirror.
  const double least = 4.0 / 3 * 3.14159265 * 2.75 * 2.75 * 2.75, most = 4.0 / 3 * 3.14159265 * 27;
  for (const char* scale : {"1", "-1", "[1, -1, 1]"}) {
    const Scene scene = read(std::string("\"scale\": ") + scale);
    ASSERT_EQ(scene.geometry.size(), 1U);
    EXPECT_TRUE(scene.volumes.empty());
    EXPECT_TRUE(scene.geometry[0].mesh->closed);
    EXPECT_TRUE(scene.geometry[0].casts && scene.geometry[0].receives);
    EXPECT_GT(volume_of(scene.geometry[0]), least) << scale;
    EXPECT_LT(volume_of(scene.geometry[0]), most) << scale;
  }
  EXPECT_EQ(
      fault(R"("extinction": 2)"),
      "level.scene.json:volumes[0].extinction: is of densities, and a.vdb:density is a level set: a solid");
}

}  // namespace
}  // namespace pdsm::test
