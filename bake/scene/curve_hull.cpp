// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/caster_hull.h"

namespace pdsm {
namespace {

constexpr double kCellsAlong = 64;
/// Share of a cell that everything is made wider by, for rounding.
constexpr double kSlack = 1e-3;

/// Bounds of a part of a segment.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void include(const glm::dvec3& p, double radius) {
    low = glm::min(low, p - radius);
    high = glm::max(high, p + radius);
  }
};

Box bounds_of(const Strands& strands) {
  Box box;
  for (const std::uint32_t first : strands.segments)
    for (std::uint32_t n = first; n <= first + 1; ++n)
      box.include(glm::dvec3(glm::vec3(strands.points[n])), static_cast<double>(strands.points[n].w));
  return box;
}

float widest_radius(const Strands& strands) {
  float widest = 0;
  for (const glm::vec4& point : strands.points) widest = std::max(widest, point.w);
  return widest;
}

/// Marks the cells of the bounds that segments reach, each in parts no longer than a cell.
class CellMarks {
 public:
  CellMarks(const Box& bounds, double edge)
      : low_(bounds.low),
        edge_(edge),
        count_(glm::ivec3(glm::floor((bounds.high - bounds.low) / edge)) + 1),
        marked_(static_cast<std::size_t>(count_.x) * static_cast<std::size_t>(count_.y) *
                static_cast<std::size_t>(count_.z)) {}

  void mark(const glm::vec4& a, const glm::vec4& b) {
    const glm::dvec3 from(a.x, a.y, a.z), to(b.x, b.y, b.z);
    const double radius = static_cast<double>(std::max(a.w, b.w)) + kSlack * edge_;
    const int parts = static_cast<int>(glm::length(to - from) / edge_) + 1;
    for (int n = 0; n < parts; ++n) {
      Box box;
      box.include(glm::mix(from, to, static_cast<double>(n) / parts), radius);
      box.include(glm::mix(from, to, static_cast<double>(n + 1) / parts), radius);
      mark(box);
    }
  }
  [[nodiscard]] std::vector<glm::ivec3> cells() const {
    std::vector<glm::ivec3> cells;
    for (std::size_t n = 0; n < marked_.size(); ++n) {
      const auto at = static_cast<std::int32_t>(n);
      if (marked_[n]) cells.emplace_back(at % count_.x, at / count_.x % count_.y, at / count_.x / count_.y);
    }
    return cells;
  }

 private:
  [[nodiscard]] glm::ivec3 cell_at(const glm::dvec3& p) const {
    return glm::clamp(glm::ivec3(glm::floor((p - low_) / edge_)), glm::ivec3(0), count_ - 1);
  }
  void mark(const Box& box) {
    const glm::ivec3 low = cell_at(box.low), high = cell_at(box.high);
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
          marked_[static_cast<std::size_t>((z * count_.y + y) * count_.x + x)] = true;
  }

  glm::dvec3 low_;
  double edge_;
  glm::ivec3 count_;
  std::vector<bool> marked_;
};

}  // namespace

CasterHull curve_hull(const Curves& curves) {
  const Strands& strands = *curves.strands;
  Box bounds = bounds_of(strands);
  const glm::dvec3 size = bounds.high - bounds.low;
  // Thick curves would only mark many small cells each.
  const double edge =
      std::max(std::max({size.x, size.y, size.z}) / kCellsAlong, static_cast<double>(widest_radius(strands)));
  bounds.include(bounds.low, kSlack * edge);
  bounds.include(bounds.high, kSlack * edge);
  CellMarks marks(bounds, edge);
  for (const std::uint32_t first : strands.segments)
    marks.mark(strands.points[first], strands.points[first + 1]);
  glm::dmat4 lattice_to_local(edge);
  lattice_to_local[3] = glm::dvec4(bounds.low, 1.0);
  return make_hull(marks.cells(), 1, curves.name, curves.local_to_world * lattice_to_local);
}

}  // namespace pdsm
