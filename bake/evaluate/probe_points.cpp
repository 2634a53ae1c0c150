// SPDX-License-Identifier: Apache-2.0
#include "evaluate/probe_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "truth/cutout_surface.h"
#include "truth/random.h"
#include "truth/solids.h"

namespace pdsm {
namespace {

/// Draws per probe before giving up: a window that holds a thousandth of the candidates still fills.
constexpr std::uint64_t kDrawsPerProbe = 4000;

/// How far off a surface its side is looked at, as a share of the depth: where shadow rays begin.
constexpr double kOffSurface = 1e-4;

/// A receiver triangle in the space of a view that may have surface in its window.
struct Candidate {
  const View* view;
  std::array<glm::dvec3, 3> corners;
  bool both_sides;
  const Mesh* mesh;
  glm::uvec3 triangle;

  [[nodiscard]] glm::dvec3 point(const glm::dvec3& weights) const {
    return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
  }
};

/// Signed distances to the window's four sides (up to a positive factor); negative is outside.
std::array<double, 4> side_distances(const View& view, const glm::dvec3& p) {
  const double w = view.projection == Projection::perspective ? p.z : 1.0;
  return {p.x - view.window[0] * w, p.y - view.window[1] * w, view.window[2] * w - p.x,
          view.window[3] * w - p.y};
}

/// Whether all corners lie beyond one side of the window's pyramid, so that no point is in it.
bool misses_window(const View& view, const std::array<glm::dvec3, 3>& corners) {
  std::array<bool, 6> beyond{true, true, true, true, true, true};
  for (const glm::dvec3& corner : corners) {
    const std::array<double, 4> sides = side_distances(view, corner);
    for (std::size_t s = 0; s < 4; ++s) beyond[s] = beyond[s] && sides[s] < 0;
    beyond[4] = beyond[4] && !(corner.z > 0);
    beyond[5] = beyond[5] && corner.z > view.far_depth;
  }
  return std::any_of(beyond.begin(), beyond.end(), [](bool all) { return all; });
}

/// Whether the side that the winding shows faces the centre of projection.
bool faces_light(const View& view, const std::array<glm::dvec3, 3>& corners) {
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const glm::dvec3 to_light = view.projection == Projection::perspective ? -corners[0] : glm::dvec3(0, 0, -1);
  return glm::dot(normal, to_light) > 0;
}

double area(const std::array<glm::dvec3, 3>& corners) {
  return 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

void append_candidates(const Geometry& geometry, const View& view, std::vector<Candidate>& candidates) {
  for (const glm::uvec3& triangle : geometry.mesh->triangles) {
    Candidate candidate{&view, {}, !geometry.mesh->closed, geometry.mesh.get(), triangle};
    for (int c = 0; c < 3; ++c) {
      const glm::vec3& local = geometry.mesh->positions[triangle[c]];
      candidate.corners[static_cast<std::size_t>(c)] = apply(view.world_to_view, to_world(geometry, local));
    }
    const double size = area(candidate.corners);
    if (!std::isfinite(size) || size <= 0 || misses_window(view, candidate.corners)) continue;
    if (candidate.both_sides || faces_light(view, candidate.corners)) candidates.push_back(candidate);
  }
}

/// Weights of a triangle's corners, uniform over it, from two numbers in [0, 1).
glm::dvec3 weights_in_triangle(const std::array<double, 2>& unit) {
  const double root = std::sqrt(unit[0]);
  return {1 - root, root * (1 - unit[1]), root * unit[1]};
}

/// Whether solids hold each side of the surface at `p` (view space) that counts.
bool is_buried(const Solids& solids, const RigidTransform& view_to_world, const Candidate& candidate,
               const glm::dvec3& p) {
  const auto& c = candidate.corners;
  const glm::dvec3 off = kOffSurface * p.z * glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
  return solids.hold(apply(view_to_world, p + off)) &&
         (!candidate.both_sides || solids.hold(apply(view_to_world, p - off)));
}

std::uint32_t texel_of(double value, double low, double high, std::uint32_t count) {
  const double texel = std::floor((value - low) / (high - low) * count);
  return static_cast<std::uint32_t>(std::clamp(texel, 0.0, static_cast<double>(count - 1)));
}

/// Uniform by volume in the window's pyramid between near and far: depth by z^3, then the slopes.
glm::dvec3 point_in_pyramid(const View& view, double depth_unit, const std::array<double, 2>& unit) {
  const double n = view.near_depth, f = view.far_depth;
  const bool perspective = view.projection == Projection::perspective;
  const double z =
      perspective ? std::cbrt(n * n * n + depth_unit * (f * f * f - n * n * n)) : n + depth_unit * (f - n);
  const double w = perspective ? z : 1.0;
  return {(view.window[0] + unit[0] * (view.window[2] - view.window[0])) * w,
          (view.window[1] + unit[1] * (view.window[3] - view.window[1])) * w, z};
}

bool within_domain(const PenumbraMap& map, std::uint32_t index, const glm::dvec3& p) {
  const View& view = map.views[index];
  const double w = view.projection == Projection::perspective ? p.z : 1.0;
  const std::uint32_t i = texel_of(p.x / w, view.window[0], view.window[2], view.width);
  const std::uint32_t j = texel_of(p.y / w, view.window[1], view.window[3], view.height);
  return p.z <= domain_end(map, index, i, j);
}

/// The part of each view that is its own: where there are several, a texel less on each side.
std::vector<View> own_parts(std::span<const View> views) {
  std::vector<View> parts(views.begin(), views.end());
  if (parts.size() == 1) return parts;
  for (View& view : parts) {
    const std::array<double, 2> texel{(view.window[2] - view.window[0]) / view.width,
                                      (view.window[3] - view.window[1]) / view.height};
    for (std::size_t a = 0; a < 2; ++a) {
      view.window[a] += texel[a];
      view.window[a + 2] -= texel[a];
    }
  }
  return parts;
}

/// Of a view's pyramid between near and far, up to a factor that all have.
double volume(const View& view) {
  const double n = view.near_depth, f = view.far_depth;
  const double across = (view.window[2] - view.window[0]) * (view.window[3] - view.window[1]);
  return across * (view.projection == Projection::perspective ? f * f * f - n * n * n : f - n);
}

}  // namespace

bool in_window(const View& view, const glm::dvec3& view_point) {
  const std::array<double, 4> sides = side_distances(view, view_point);
  return view_point.z > 0 && std::all_of(sides.begin(), sides.end(), [](double s) { return s >= 0; });
}

double domain_end(const PenumbraMap& map, std::uint32_t index, std::uint32_t i, std::uint32_t j) {
  const View& view = map.views[index];
  const FunctionImage& image = *std::ranges::find_if(
      map.images, [&](const FunctionImage& of) { return of.view == index && of.level == 0; });
  const std::uint32_t bx = i / kBlockSize, by = j / kBlockSize;
  const FunctionBlock& block = image.blocks[std::size_t{by} * image.blocks_across() + bx];
  if (block.domain_end.empty()) return view.far_depth;
  const std::uint32_t width = block_extent(image.width, image.height, bx, by)[0];
  const std::uint32_t texel = (j % kBlockSize) * width + i % kBlockSize;
  return decode_depth(view, map.coding, block.domain_end[texel]);
}

SurfaceProbes surface_probes(const Scene& scene, std::span<const View> views, std::uint32_t count,
                             std::uint64_t seed) {
  const std::vector<View> parts = own_parts(views);
  std::vector<Candidate> candidates;
  for (const View& view : parts) {
    for (const Geometry& geometry : scene.geometry) {
      if (geometry.receives) append_candidates(geometry, view, candidates);
    }
  }
  SurfaceProbes probes;
  if (candidates.empty()) return probes;

  // Triangles are drawn by area; what falls outside the window or into a hole, or is buried, is drawn again.
  std::vector<double> area_up_to;
  double total = 0;
  for (const Candidate& candidate : candidates) area_up_to.push_back(total += area(candidate.corners));
  const Solids solids(scene);
  for (std::uint64_t draw = 0; draw < kDrawsPerProbe * count && probes.points.size() < count; ++draw) {
    const double at = hash_unit(seed, 2 * draw) * total;
    const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end() - 1, at);
    const Candidate& candidate = candidates[static_cast<std::size_t>(found - area_up_to.begin())];
    const View& view = *candidate.view;
    const RigidTransform view_to_world = inverse(view.world_to_view);
    const glm::dvec3 weights = weights_in_triangle(hash_unit_pair(seed, 2 * draw + 1));
    const glm::dvec3 p = candidate.point(weights);
    if (!in_window(view, p) || p.z > view.far_depth) continue;
    if (is_hole(*candidate.mesh, candidate.triangle, weights)) continue;
    if (is_buried(solids, view_to_world, candidate, p)) {
      ++probes.buried;
    } else {
      probes.points.push_back(apply(view_to_world, p));
    }
  }
  return probes;
}

std::vector<glm::dvec3> free_probes(const PenumbraMap& map, std::uint32_t count, std::uint64_t seed) {
  const std::vector<View> parts = own_parts(map.views);
  std::vector<double> volume_up_to;
  double total = 0;
  for (const View& view : parts) volume_up_to.push_back(total += volume(view));
  std::vector<glm::dvec3> probes;
  for (std::uint64_t draw = 0; draw < kDrawsPerProbe * count && probes.size() < count; ++draw) {
    const auto found =
        std::upper_bound(volume_up_to.begin(), volume_up_to.end() - 1, hash_unit(~seed, draw) * total);
    const auto index = static_cast<std::uint32_t>(found - volume_up_to.begin());
    const View& view = parts[index];
    const glm::dvec3 p =
        point_in_pyramid(view, hash_unit(seed, 2 * draw), hash_unit_pair(seed, 2 * draw + 1));
    if (within_domain(map, index, p)) probes.push_back(apply(inverse(view.world_to_view), p));
  }
  return probes;
}

}  // namespace pdsm
