// SPDX-License-Identifier: Apache-2.0
#include "tile/shadow_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace pdsm {
namespace {

/// Widening of a triangle's reach in map texels: a walk reads texels whose centres are up to one texel off.
constexpr double kTexelReach = 1.01;
/// From so many cells on, it pays to ask for each cell whether the triangle's plane is crossed at all.
constexpr std::int64_t kManyCells = 8;
/// Triangles that follow each other in a mesh and are asked about together first.
constexpr std::size_t kRun = 64;
/// Casters count as behind all samples from so many times the farthest sample's depth on.
constexpr double kBehindSamples = 1.01;

/// A triangle in front of clip_depth: 3 or 4 corners, or none.
struct ClippedTriangle {
  glm::dvec3 corner[4];
  int count = 0;

  [[nodiscard]] std::span<const glm::dvec3> corners() const {
    return {corner, static_cast<std::size_t>(count)};
  }
};

/// A box around triangles, in front of clip_depth.
struct RunBox {
  glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};

  void include(const LightSpaceMesh& mesh, const glm::uvec3& t) {
    for (const std::uint32_t v : {t.x, t.y, t.z}) {
      low = glm::min(low, mesh.positions[v]);
      high = glm::max(high, mesh.positions[v]);
    }
  }
  /// None where all of it lies before clip_depth.
  [[nodiscard]] bool clip(double clip_depth, std::array<glm::dvec3, 8>& corners) const {
    if (!(static_cast<double>(high.z) >= clip_depth)) return false;
    const double first = std::max(static_cast<double>(low.z), clip_depth);
    for (std::size_t n = 0; n < 8; ++n)
      corners[n] = {(n & 1U) != 0 ? high.x : low.x, (n & 2U) != 0 ? high.y : low.y,
                    (n & 4U) != 0 ? static_cast<double>(high.z) : first};
    return true;
  }
};

ClippedTriangle clip_front(const LightSpaceMesh& mesh, const glm::uvec3& t, double clip_depth) {
  const glm::dvec3 p[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
  ClippedTriangle result;
  for (int n = 0; n < 3; ++n) {
    const glm::dvec3 &a = p[n], &b = p[(n + 1) % 3];
    if (a.z >= clip_depth) result.corner[result.count++] = a;
    if ((a.z >= clip_depth) != (b.z >= clip_depth)) {
      result.corner[result.count++] = a + (b - a) * ((clip_depth - a.z) / (b.z - a.z));
    }
  }
  return result;
}

/// Cells of a tile, half-open, of a range that takes `of_map` cells of the whole map.
struct CellRange {
  std::int64_t x0, y0, x1, y1, of_map;
};

class CellMarker {
 public:
  CellMarker(const ShadowCellInput& input, const TexelRect& tile, const DomainEndAt& domain_end)
      : input_(input),
        domain_end_(domain_end),
        cells_{tile,
               (tile.x1 - tile.x0 + kCellSize - 1) / kCellSize,
               (tile.y1 - tile.y0 + kCellSize - 1) / kCellSize,
               {},
               {}} {
    cells_.dark.assign(cell_count(), 0);
    find_last_ends();
  }

  ShadowCells run() {
    for (const LightSpaceMesh& mesh : input_.scene.meshes) {
      if (mesh.casts) mark_mesh(mesh);
    }
    input_.scene.visit_hulls([this](const LightSpaceHull& hull) { mark_hull(hull); });
    find_idle_casters();
    return std::move(cells_);
  }

 private:
  [[nodiscard]] std::size_t cell_count() const {
    return static_cast<std::size_t>(cells_.across) * static_cast<std::size_t>(cells_.up);
  }

  void find_last_ends() {
    last_end_.assign(cell_count(), 0);
    for (std::int32_t y = 0; y < cells_.up; ++y) {
      for (std::int32_t x = 0; x < cells_.across; ++x) {
        float& last = last_end_[static_cast<std::size_t>(y * cells_.across + x)];
        for_each_ray(x, y, [&](std::int32_t i, std::int32_t j) {
          last = std::max(last, domain_end_(i, j));
          return true;
        });
      }
    }
  }

  /// Calls visit(i, j) for the rays of a cell until it returns false; tells whether it never did.
  template <typename Visitor>
  bool for_each_ray(std::int32_t x, std::int32_t y, Visitor&& visit) const {
    const TexelRect rect = cells_.cell_rect(x, y);
    for (std::int32_t j = rect.y0; j < rect.y1; ++j) {
      for (std::int32_t i = rect.x0; i < rect.x1; ++i) {
        if (!visit(i, j)) return false;
      }
    }
    return true;
  }

  /// What is in a hull darkens through its surface, unless light begins within.
  void mark_hull(const LightSpaceHull& hull) {
    if (hull.begins_before(std::max(kEmitterShare * input_.grid.far_depth, input_.light.max_z)))
      std::ranges::fill(cells_.dark, std::uint8_t{1});
    else
      mark_mesh(hull.surface);
  }

  /// Each thread marks cells of its own; a mark never depends on other marks.
  void mark_mesh(const LightSpaceMesh& mesh) {
#pragma omp parallel num_threads(static_cast <int>(input_.threads))
    {
      std::vector<std::uint8_t> dark(cell_count(), 0);
#pragma omp for schedule(static) nowait
      for (std::size_t t = 0; t < mesh.triangles.size(); t += kRun)
        mark_run(mesh, std::span(mesh.triangles).subspan(t, std::min(kRun, mesh.triangles.size() - t)), dark);
#pragma omp critical
      for (std::size_t c = 0; c < dark.size(); ++c) cells_.dark[c] |= dark[c];
    }
  }

  /// Neighbours reach the same few cells: most runs find these marked.
  void mark_run(const LightSpaceMesh& mesh, std::span<const glm::uvec3> run,
                std::vector<std::uint8_t>& dark) const {
    if (changes_nothing(mesh, run, dark)) return;
    for (const glm::uvec3& t : run) mark_triangle(mesh, t, dark);
  }

  [[nodiscard]] bool changes_nothing(const LightSpaceMesh& mesh, std::span<const glm::uvec3> run,
                                     const std::vector<std::uint8_t>& dark) const {
    if (input_.light_hull != nullptr) return false;
    RunBox box;
    for (const glm::uvec3& t : run) box.include(mesh, t);
    std::array<glm::dvec3, 8> corners;
    if (!box.clip(input_.clip_depth, corners)) return true;
    const double first_depth = corners[0].z;
    const CellRange range = find_range(corners, first_depth);
    for (std::int64_t y = range.y0; y < range.y1; ++y) {
      for (std::int64_t x = range.x0; x < range.x1; ++x) {
        const auto cell = static_cast<std::size_t>(y * cells_.across + x);
        if (dark[cell] == 0 && first_depth < static_cast<double>(last_end_[cell])) return false;
      }
    }
    return true;
  }

  void mark_triangle(const LightSpaceMesh& mesh, const glm::uvec3& t, std::vector<std::uint8_t>& dark) const {
    for_each_cell_near(mesh, t, [&](std::int32_t x, std::int32_t y, std::size_t cell, bool are_many) {
      if (dark[cell] == 0 && !(are_many && stays_in_front(mesh, t, x, y))) dark[cell] = 1;
      return true;
    });
  }

  /// Calls visit(x, y, cell, are_many) for the cells that a triangle may reach before their ends, until it
  /// returns false; `are_many`: so many are in range that asking for each may pay.
  template <typename Visitor>
  void for_each_cell_near(const LightSpaceMesh& mesh, const glm::uvec3& t, Visitor&& visit) const {
    if (input_.light_hull != nullptr) {
      const SmallPolygon part = part_in_hull(mesh, t);
      visit_cells(part.corners(), std::forward<Visitor>(visit));
    } else {
      const ClippedTriangle triangle = clip_front(mesh, t, input_.clip_depth);
      visit_cells(triangle.corners(), std::forward<Visitor>(visit));
    }
  }

  /// What of a triangle lies in the hull of light and window.
  [[nodiscard]] SmallPolygon part_in_hull(const LightSpaceMesh& mesh, const glm::uvec3& t) const {
    const ConvexRegion& hull = *input_.light_hull;
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    return clip({a, b, c}, hull, hull.outside_bits(a) | hull.outside_bits(b) | hull.outside_bits(c));
  }

  template <typename Visitor>
  void visit_cells(std::span<const glm::dvec3> corners, Visitor&& visit) const {
    if (corners.empty()) return;
    double first_depth = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& corner : corners) first_depth = std::min(first_depth, corner.z);
    const CellRange range = find_range(corners, first_depth);
    // Not those of the tile, for a verdict must not depend on it.
    const bool are_many = range.of_map >= kManyCells;
    for (std::int64_t y = range.y0; y < range.y1; ++y) {
      for (std::int64_t x = range.x0; x < range.x1; ++x) {
        const auto cell = static_cast<std::size_t>(y * cells_.across + x);
        if (first_depth >= static_cast<double>(last_end_[cell])) continue;
        if (!visit(static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), cell, are_many)) return;
      }
    }
  }

  void find_idle_casters() {
    const auto& large = input_.casters.large;
    std::vector<std::uint8_t> idle(large.size(), 0);
#pragma omp parallel for schedule(dynamic) num_threads(static_cast <int>(input_.threads))
    for (std::size_t n = 0; n < large.size(); ++n) {
      const LightSpaceMesh& mesh = input_.scene.meshes[large[n].mesh];
      idle[n] = can_darken(mesh, mesh.triangles[large[n].triangle]) ? 0 : 1;
    }
    for (std::size_t n = 0; n < large.size(); ++n)
      if (idle[n] != 0) cells_.idle_casters.push_back(large[n].slot);
  }

  /// Whether a triangle may darken any ray of the cells that are looked at.
  [[nodiscard]] bool can_darken(const LightSpaceMesh& mesh, const glm::uvec3& t) const {
    bool found = false;
    for_each_cell_near(mesh, t, [&](std::int32_t x, std::int32_t y, std::size_t cell, bool) {
      found = cells_.dark[cell] != 0 && !stays_in_front(mesh, t, x, y);
      return !found;
    });
    return found;
  }

  /// Cells that the hull of `corners` may darken.
  [[nodiscard]] CellRange find_range(std::span<const glm::dvec3> corners, double first_depth) const {
    if (input_.light_hull != nullptr && !(first_depth > kBehindSamples * input_.light.max_z))
      return all_cells();
    const Spread spread = spread_from(first_depth);
    std::int64_t low[2], high[2], of_map = 1;
    const std::int32_t start[2] = {cells_.tile.x0, cells_.tile.y0}, cells[2] = {cells_.across, cells_.up};
    for (int a = 0; a < 2; ++a) {
      double least = std::numeric_limits<double>::infinity(), greatest = -least;
      for (const glm::dvec3& corner : corners) {
        const double slope = corner[a] / input_.grid.spread_at(corner.z);
        least = std::min(least, slope);
        greatest = std::max(greatest, slope);
        if (input_.light_hull != nullptr) include_farthest(a, corner, least, greatest);
      }
      const auto axis = static_cast<std::size_t>(a);
      const MapGrid& grid = input_.grid;
      const double pad = kTexelReach * grid.pitch[axis],
                   pitch = grid.pitch[axis] * grid.ratio[axis].maps_per_texel();
      least += spread.least[axis] - pad;
      greatest += spread.greatest[axis] + pad;
      const double first = (least - grid.origin[axis]) / pitch, last = (greatest - grid.origin[axis]) / pitch;
      low[a] = std::max<std::int64_t>(to_cell(first, start[a], cells[a]), 0);
      high[a] = to_cell(last, start[a], cells[a] - 1) + 1;
      const auto across = static_cast<std::int32_t>((grid.texels[axis] + kCellSize - 1) / kCellSize);
      of_map *= std::max<std::int64_t>(
          to_cell(last, 0, across - 1) + 1 - std::max<std::int64_t>(to_cell(first, 0, across), 0), 0);
    }
    return {low[0], low[1], high[0], high[1], of_map};
  }

  [[nodiscard]] CellRange all_cells() const {
    const auto along = [this](std::size_t a) { return (input_.grid.texels[a] + kCellSize - 1) / kCellSize; };
    return {0, 0, cells_.across, cells_.up, std::int64_t{along(0)} * along(1)};
  }

  /// Slopes along `axis` at which the shadows of a caster point end at far, of samples out of the plane.
  void include_farthest(int axis, const glm::dvec3& corner, double& least, double& greatest) const {
    const auto a = static_cast<std::size_t>(axis);
    const LightBounds& light = input_.light;
    const double far = input_.grid.far_depth;
    for (const double s : {light.min[a], light.max[a]}) {
      for (const double s_z : {light.min_z, light.max_z}) {
        const double slope = (s + (corner[axis] - s) * (far - s_z) / (corner.z - s_z)) / far;
        least = std::min(least, slope);
        greatest = std::max(greatest, slope);
      }
    }
  }

  /// How far beside a caster point its shadow falls on rays.
  struct Spread {
    std::array<double, 2> least{}, greatest{};
  };
  /// Of what lies from `first_depth` on.
  [[nodiscard]] Spread spread_from(double first_depth) const {
    const MapGrid& grid = input_.grid;
    const LightBounds& light = input_.light;
    Spread spread;
    if (input_.light_hull != nullptr) return spread;
    for (std::size_t a = 0; a < 2; ++a) {
      if (grid.perspective()) {
        const double reach = std::max(0.0, 1 / first_depth - 1 / grid.far_depth);
        spread.least[a] = -light.max[a] * reach;
        spread.greatest[a] = -light.min[a] * reach;
      } else {
        const double reach = std::max(0.0, grid.far_depth - first_depth);
        spread.least[a] = light.min[a] * reach;
        spread.greatest[a] = light.max[a] * reach;
      }
    }
    return spread;
  }

  /// Cell of a texel coordinate, counted from that of texel `start`, between -1 and `most`.
  static std::int64_t to_cell(double texel, std::int32_t start, std::int32_t most) {
    return static_cast<std::int64_t>(
        std::clamp(std::floor(texel / kCellSize) - start / kCellSize, -1.0, static_cast<double>(most)));
  }

  /// Whether light and all rays of a cell, up to their ends, stay on one side of the triangle's plane.
  [[nodiscard]] bool stays_in_front(const LightSpaceMesh& mesh, const glm::uvec3& t, std::int32_t x,
                                    std::int32_t y) const {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    glm::dvec3 normal = glm::cross(b - a, c - a);
    double offset = glm::dot(normal, a);
    // Turned so that the light's centre is in front: normal . P >= offset.
    const bool parallel = !input_.grid.perspective();
    if (parallel ? normal.z > 0 : offset > 0) {
      normal = -normal;
      offset = -offset;
    }
    for (const double light_x : {input_.light.min[0], input_.light.max[0]}) {
      for (const double light_y : {input_.light.min[1], input_.light.max[1]}) {
        const double across = normal.x * light_x + normal.y * light_y;
        // A distant light's rays (x, y, 1) have to come from the front.
        if (parallel ? across + normal.z > 0 : across + least_along_z(normal.z) < offset) return false;
      }
    }
    return for_each_ray(x, y, [&](std::int32_t i, std::int32_t j) {
      const CentralRay ray = input_.grid.ray(input_.grid.center_slope(0, static_cast<std::uint32_t>(i)),
                                             input_.grid.center_slope(1, static_cast<std::uint32_t>(j)));
      const double rate = glm::dot(normal, ray.direction), start = glm::dot(normal, ray.origin);
      const double end = static_cast<double>(domain_end_(i, j)) - input_.depth_rounding;
      return (rate >= 0 && start >= offset) || start + end * rate >= offset;
    });
  }

  /// The least of z times `normal_z` over all samples.
  [[nodiscard]] double least_along_z(double normal_z) const {
    return std::min(normal_z * input_.light.min_z, normal_z * input_.light.max_z);
  }

  const ShadowCellInput& input_;
  const DomainEndAt& domain_end_;
  ShadowCells cells_;
  std::vector<float> last_end_;
};

}  // namespace

TexelRect ShadowCells::cell_rect(std::int32_t x, std::int32_t y) const {
  const std::int32_t x0 = tile.x0 + x * kCellSize, y0 = tile.y0 + y * kCellSize;
  return {x0, y0, std::min(x0 + kCellSize, tile.x1), std::min(y0 + kCellSize, tile.y1)};
}

std::uint64_t ShadowCells::undarkened_texels(const TexelRect& rect) const {
  if (dark.empty()) return 0;
  std::uint64_t texels = 0;
  for (std::int32_t y = (rect.y0 - tile.y0) / kCellSize; y * kCellSize < rect.y1 - tile.y0; ++y)
    for (std::int32_t x = (rect.x0 - tile.x0) / kCellSize; x * kCellSize < rect.x1 - tile.x0; ++x)
      if (!may_darken(x, y)) texels += cell_rect(x, y).area();
  return texels;
}

ShadowCells find_shadow_cells(const ShadowCellInput& input, const TexelRect& tile,
                              const DomainEndAt& domain_end) {
  return CellMarker(input, tile, domain_end).run();
}

}  // namespace pdsm
