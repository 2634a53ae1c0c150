// SPDX-License-Identifier: Apache-2.0
#include "vdb_files.h"

// Of the tests, the only file that includes OpenVDB.
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

namespace pdsm::test {
namespace {

openvdb::Coord coord(const std::array<int, 3>& at) {
  return {at[0], at[1], at[2]};
}

openvdb::math::Transform::Ptr transform_of(const VdbGrid& wanted) {
  if (wanted.kind == VdbGrid::Kind::frustum)
    return openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(10)), 0.5, 10, 1);
  auto transform = openvdb::math::Transform::createLinearTransform(wanted.voxel_size);
  transform->postTranslate({wanted.move[0], wanted.move[1], wanted.move[2]});
  return transform;
}

openvdb::GridBase::Ptr make_grid(const VdbGrid& wanted) {
  if (wanted.kind == VdbGrid::Kind::doubles) return openvdb::DoubleGrid::create();
  if (wanted.kind == VdbGrid::Kind::level_set)
    return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        static_cast<float>(wanted.radius * wanted.voxel_size), openvdb::Vec3f(0),
        static_cast<float>(wanted.voxel_size));
  auto grid = openvdb::FloatGrid::create(wanted.background);
  for (const VdbGrid::Voxel& voxel : wanted.voxels) grid->tree().setValue(coord(voxel.at), voxel.value);
  const openvdb::CoordBBox box(coord(wanted.filled[0]), coord(wanted.filled[1]));
  if (!box.empty()) grid->tree().fill(box, 1);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(transform_of(wanted));
  return grid;
}

}  // namespace

void write_vdb(const std::filesystem::path& path, const std::vector<VdbGrid>& grids) {
  openvdb::initialize();
  openvdb::GridPtrVec made;
  for (const VdbGrid& wanted : grids) {
    made.push_back(make_grid(wanted));
    made.back()->setName(wanted.name);
  }
  openvdb::io::File file(path.string());
  file.write(made);
  file.close();
}

}  // namespace pdsm::test
