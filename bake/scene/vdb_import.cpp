// SPDX-License-Identifier: Apache-2.0
#include "scene/vdb_import.h"

// The only file that includes OpenVDB: it takes as long to compile as all of its neighbours.
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <sstream>
#include <tuple>
#include <utility>

#include "scene/format_fault.h"
#include "scene/one_line.h"

namespace pdsm {
namespace {

constexpr std::int32_t kEdge = DensityBrick::kEdge;

/// Names as a message lists them.
std::string list_names(const openvdb::GridPtrVec& grids) {
  std::string names;
  for (const auto& grid : grids) names += (names.empty() ? "\"" : ", \"") + one_line(grid->getName()) + "\"";
  return names.empty() ? "it has none" : "it has " + names;
}

openvdb::GridBase::Ptr find_grid(const openvdb::GridPtrVec& grids, const std::string& name) {
  const auto found =
      std::ranges::find_if(grids, [&](const auto& grid) { return grid && grid->getName() == name; });
  if (found != grids.end()) return *found;
  throw FormatFault("no grid \"" + one_line(name) + "\"; " + list_names(grids));
}

openvdb::GridPtrVec read_grids(std::string bytes) {
  std::istringstream stream(std::move(bytes), std::ios::binary);
  // Behind the end of a file, OpenVDB would go on with whatever memory holds, sizes included.
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  try {
    // Loaded at once: later, the stream would be gone.
    openvdb::io::Stream file(stream, false);
    const auto grids = file.getGrids();
    return grids ? *grids : openvdb::GridPtrVec{};
  } catch (const std::ios::failure&) {
    throw FormatFault("is no OpenVDB file that can be read: it ends too soon");
  }
}

/// OpenVDB's matrices take rows from the left.
glm::dmat4 index_to_file(const openvdb::GridBase& grid) {
  if (!grid.transform().isLinear()) throw FormatFault("has a frustum's transform: must be affine");
  const openvdb::Mat4d from = grid.transform().baseMap()->getAffineMap()->getMat4();
  glm::dmat4 to;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) to[row][column] = from(row, column);
  return to;
}

/// Gathers the densities of a grid in bricks.
class BrickCollector {
 public:
  explicit BrickCollector(const openvdb::FloatGrid& grid) : grid_(grid) {}

  std::shared_ptr<const DensityGrid> run() {
    check_size();
    for (auto leaf = grid_.tree().cbeginLeaf(); leaf; ++leaf) add_leaf(*leaf);
    for (auto tile = grid_.tree().cbeginValueOn(); tile; ++tile)
      if (!tile.isVoxelValue()) add_tile(tile.getBoundingBox(), tile.getValue());
    const auto key = [](const DensityBrick& b) { return std::tuple(b.first.z, b.first.y, b.first.x); };
    std::ranges::sort(result_->bricks, {}, key);
    return result_;
  }

 private:
  /// Before tiles, which a few bytes tell of, become bricks.
  void check_size() const {
    std::uint64_t bricks = grid_.tree().leafCount();
    for (auto tile = grid_.tree().cbeginValueOn(); tile; ++tile)
      if (!tile.isVoxelValue()) bricks += std::max<std::uint64_t>(tile.getVoxelCount() / 512, 1);
    if (bricks > kMostBricks) throw FormatFault("has more than 1048576 bricks of 8 x 8 x 8 voxels");
  }

  static float checked(float density) {
    if (std::isnan(density)) throw FormatFault("has densities that are NaN");
    if (std::isinf(density)) throw FormatFault("has infinite densities");
    if (density < 0) throw FormatFault("has negative densities");
    return density;
  }

  void add_leaf(const openvdb::FloatTree::LeafNodeType& leaf) {
    DensityBrick brick;
    const openvdb::Coord first = leaf.origin();
    brick.first = {first.x(), first.y(), first.z()};
    bool any = false;
    for (auto value = leaf.cbeginValueOn(); value; ++value) {
      const openvdb::Coord at = value.getCoord() - first;
      brick.density[DensityBrick::at(at.x(), at.y(), at.z())] = checked(*value);
      any = any || *value > 0;
    }
    if (any) result_->bricks.push_back(brick);
  }

  void add_tile(const openvdb::CoordBBox& box, float density) {
    if (checked(density) == 0) return;
    DensityBrick brick;
    brick.density.fill(density);
    for (std::int32_t z = box.min().z(); z <= box.max().z(); z += kEdge) {
      for (std::int32_t y = box.min().y(); y <= box.max().y(); y += kEdge) {
        for (std::int32_t x = box.min().x(); x <= box.max().x(); x += kEdge) {
          brick.first = {x, y, z};
          result_->bricks.push_back(brick);
        }
      }
    }
  }

  const openvdb::FloatGrid& grid_;
  std::shared_ptr<DensityGrid> result_ = std::make_shared<DensityGrid>();
};

/// The surface of a level set in index coordinates, its front outside.
std::shared_ptr<const Mesh> surface_of(const openvdb::FloatGrid& grid) {
  // Another grid of the same tree, whose index coordinates are its own space.
  const openvdb::FloatGrid in_index_space(std::const_pointer_cast<openvdb::FloatTree>(grid.treePtr()));
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(in_index_space, points, quads);
  auto mesh = std::make_shared<Mesh>();
  for (const openvdb::Vec3s& p : points) mesh->positions.emplace_back(p.x(), p.y(), p.z());
  for (const openvdb::Vec4I& q : quads) {
    mesh->triangles.emplace_back(q[0], q[1], q[2]);
    mesh->triangles.emplace_back(q[0], q[2], q[3]);
  }
  return mesh;
}

ImportedGrid import_grid(const openvdb::GridBase& base) {
  if (!base.isType<openvdb::FloatGrid>())
    throw FormatFault("must be a grid of floats, is one of " + one_line(base.valueType()));
  const auto& grid = static_cast<const openvdb::FloatGrid&>(base);
  ImportedGrid imported;
  imported.index_to_file = index_to_file(grid);
  if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) {
    imported.solid = surface_of(grid);
    return imported;
  }
  if (grid.background() != 0) throw FormatFault("has a density of its own outside of its voxels");
  imported.density = BrickCollector(grid).run();
  return imported;
}

ImportedGrid read_grid(std::string bytes, const std::string& name) {
  openvdb::initialize();
  const openvdb::GridBase::Ptr grid = find_grid(read_grids(std::move(bytes)), name);
  try {
    return import_grid(*grid);
  } catch (const FormatFault& fault) {
    throw FormatFault(name + ": " + fault.what());
  }
}

}  // namespace

ImportedGrid import_vdb(std::string bytes, const std::string& grid) {
  try {
    return read_grid(std::move(bytes), grid);
  } catch (const FormatFault&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw FormatFault("needs more memory than there is");
  } catch (const std::exception& fault) {
    // OpenVDB's own exceptions are such, too.
    throw FormatFault("is no OpenVDB file that can be read: " + one_line(fault.what()));
  }
}

}  // namespace pdsm
