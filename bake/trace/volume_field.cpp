// SPDX-License-Identifier: Apache-2.0
//
// Papers: Amanatides, Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987.
#include "trace/volume_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/caster_hull.h"

namespace pdsm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Blocks along a ray, one after the other: which axis is crossed next, and where.
struct BlockSteps {
  glm::ivec3 block, step;
  glm::dvec3 next, across;  ///< t of the next border along each axis, and from one border to the next

  /// From the block that `t` is in, or next to it by rounding; within 0 .. count - 1.
  BlockSteps(const CentralRay& ray, double t, const glm::ivec3& count) {
    constexpr double kEdge = DensityBrick::kEdge;
    for (int axis = 0; axis < 3; ++axis) {
      const double o = ray.origin[axis], d = ray.direction[axis];
      block[axis] = std::clamp(static_cast<int>(std::floor((o + t * d) / kEdge)), 0, count[axis] - 1);
      step[axis] = d > 0 ? 1 : -1;
      const double border = kEdge * (block[axis] + (d > 0 ? 1 : 0));
      next[axis] = d == 0 ? kInfinity : (border - o) / d;
      across[axis] = d == 0 ? kInfinity : kEdge / std::abs(d);
    }
  }
  [[nodiscard]] int axis() const {
    return next.x <= next.y ? (next.x <= next.z ? 0 : 2) : (next.y <= next.z ? 1 : 2);
  }
  [[nodiscard]] double end() const { return next[axis()]; }
  /// Whether there is a block behind this one.
  bool advance(const glm::ivec3& count) {
    const int a = axis();
    next[a] += across[a];
    block[a] += step[a];
    return block[a] >= 0 && block[a] < count[a];
  }
};

/// Cuts [begin, end) to where the ray is within the box from 0 to `high`.
void clip_to_box(const CentralRay& ray, const glm::dvec3& high, double& begin, double& end) {
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (o < 0 || o > high[axis]) end = -kInfinity;
      continue;
    }
    const double a = -o / d, b = (high[axis] - o) / d;
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
}

}  // namespace

/// One ray on its way.
class VolumeField::March {
 public:
  March(const VolumeField& field, const CentralRay& ray, double at, std::vector<MarchedPart>& parts)
      : field_(field), at_(at), parts_(parts) {
    const glm::dmat4& m = field.light_to_index_;
    ray_.origin = glm::dvec3(m * glm::dvec4(ray.origin, 1.0)) - glm::dvec3(field.low_);
    ray_.direction = glm::dmat3(m) * ray.direction;
    scale_ = field.extinction_ * glm::length(ray.direction);
    voxels_across_ = glm::length(ray_.direction);
  }

  void run(double begin, double end) {
    clip_to_box(ray_, glm::dvec3(field_.blocks_ * kEdge), begin, end);
    if (!(begin < end)) return;
    BlockSteps steps(ray_, begin, field_.blocks_);
    do {
      const double block_end = std::min(steps.end(), end);
      const std::int32_t place = field_.places_[field_.index(steps.block)];
      if (place >= 0 && begin < block_end) run_block(place, steps.block * kEdge, begin, block_end);
      begin = std::max(begin, block_end);
    } while (begin < end && steps.advance(field_.blocks_));
  }

 private:
  void run_block(std::int32_t place, const glm::ivec3& first, double begin, double end) {
    const Block& block = field_.block_[static_cast<std::size_t>(place)];
    const double voxels = (end - begin) * voxels_across_;
    const double most = std::clamp(kPartDepth * voxels_across_ / (scale_ * static_cast<double>(block.most)),
                                   kShortestPart, kLongestPart);
    const double count = std::ceil(voxels / most), part = (end - begin) / count;
    const double depth = scale_ * part;
    const glm::vec3 origin(ray_.origin + (begin + at_ * part) * ray_.direction - glm::dvec3(first));
    const glm::vec3 step(part * ray_.direction);
    for (int n = 0; n < static_cast<int>(count); ++n) {
      const float density = block.at(origin + static_cast<float>(n) * step);
      if (density > 0)
        parts_.push_back({begin + n * part, begin + (n + 1) * part, depth * static_cast<double>(density)});
    }
  }

  const VolumeField& field_;
  double at_;
  std::vector<MarchedPart>& parts_;
  CentralRay ray_;  ///< in index coordinates, from the first lattice point
  double scale_ = 0, voxels_across_ = 0;
};

/// Trilinear, at a point within the block or off it by rounding.
float VolumeField::Block::at(const glm::vec3& p) const {
  const glm::ivec3 cell = glm::clamp(glm::ivec3(p), 0, kEdge - 1);
  const float* c = corner.data() + (cell.z * kCorners + cell.y) * kCorners + cell.x;
  const glm::vec3 w = p - glm::vec3(cell);
  constexpr int kRow = kCorners, kLayer = kCorners * kCorners;
  const float x0 = c[0] + w.x * (c[1] - c[0]), x1 = c[kRow] + w.x * (c[kRow + 1] - c[kRow]),
              x2 = c[kLayer] + w.x * (c[kLayer + 1] - c[kLayer]),
              x3 = c[kLayer + kRow] + w.x * (c[kLayer + kRow + 1] - c[kLayer + kRow]);
  const float y0 = x0 + w.y * (x1 - x0), y1 = x2 + w.y * (x3 - x2);
  return y0 + w.z * (y1 - y0);
}

VolumeField::VolumeField(const LightSpaceVolume& volume)
    : light_to_index_(volume.light_to_index), extinction_(volume.extinction) {
  const std::vector<glm::ivec3> cells = occupied_cells(*volume.grid);
  if (cells.empty()) return;
  glm::ivec3 high = low_ = cells.front();
  for (const glm::ivec3& first : cells) {
    low_ = glm::min(low_, first);
    high = glm::max(high, first);
  }
  blocks_ = (high - low_) / kEdge + 1;
  places_.assign(static_cast<std::size_t>(blocks_.x) * static_cast<std::size_t>(blocks_.y) *
                     static_cast<std::size_t>(blocks_.z),
                 -1);
  for (const glm::ivec3& first : cells) {
    places_[index((first - low_) / kEdge)] = static_cast<std::int32_t>(block_.size());
    block_.emplace_back();
  }
  fill(*volume.grid);
}

std::size_t VolumeField::index(const glm::ivec3& block) const {
  const auto [x, y, z] = std::array{static_cast<std::size_t>(block.x), static_cast<std::size_t>(block.y),
                                    static_cast<std::size_t>(block.z)};
  return (z * static_cast<std::size_t>(blocks_.y) + y) * static_cast<std::size_t>(blocks_.x) + x;
}

/// A brick's first layers are the last corners of the blocks before it.
void VolumeField::fill(const DensityGrid& grid) {
  for (const DensityBrick& brick : grid.bricks) {
    for (int n = 0; n < 8; ++n) {
      const glm::ivec3 before(n & 1, n >> 1 & 1, n >> 2 & 1);
      const glm::ivec3 at = (brick.first - low_) / kEdge - before;
      if (glm::any(glm::lessThan(at, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(at, blocks_)))
        continue;
      const std::int32_t place = places_[index(at)];
      if (place < 0) continue;
      Block& block = block_[static_cast<std::size_t>(place)];
      const glm::ivec3 end = glm::ivec3(kEdge) - before * (kEdge - 1);
      for (int z = 0; z < end.z; ++z)
        for (int y = 0; y < end.y; ++y)
          for (int x = 0; x < end.x; ++x)
            block.corner[static_cast<std::size_t>(
                ((z + before.z * kEdge) * kCorners + y + before.y * kEdge) * kCorners + x +
                before.x * kEdge)] = brick.density[DensityBrick::at(x, y, z)];
    }
  }
  for (Block& block : block_) block.most = *std::ranges::max_element(block.corner);
}

void VolumeField::march(const CentralRay& ray, double begin, double end, double at,
                        std::vector<MarchedPart>& parts) const {
  if (!block_.empty()) March(*this, ray, at, parts).run(begin, end);
}

}  // namespace pdsm
