// SPDX-License-Identifier: Apache-2.0
#include "trace/cutout_holes.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "trace/embree_scene.h"
#include "trace/map_rays.h"
#include "trace/mask_alpha.h"
#include "trace/masked_triangles.h"
#include "trace/traced_mesh.h"

namespace pdsm {
namespace {

/// A point of a triangle, by the weights of its second and third corner.
using Weights = glm::dvec2;

/// Of unit vectors' products: more than what floats make of them.
constexpr double kRounding = 0x1p-18;

bool is_within(const Weights& w) {
  return w.x >= 0 && w.y >= 0 && w.x + w.y <= 1;
}

glm::dvec2 place_at(const MaskedTriangle& triangle, const Weights& w) {
  const auto& places = triangle.places;
  return places[0] + w.x * (places[1] - places[0]) + w.y * (places[2] - places[0]);
}

/// Two numbers from -1/2 to 1/2.
glm::dvec2 random_offset(const CutoutRays& rays, unsigned lane, std::uint64_t triangle) {
  const std::array<std::uint64_t, 4> of{rays.sample_key, triangle,
                                        std::uint64_t{static_cast<std::uint32_t>(rays.lower_texel[0])} << 32 |
                                            static_cast<std::uint32_t>(rays.lower_texel[1]),
                                        lane};
  const std::uint64_t bits = XXH3_64bits(of.data(), sizeof of);
  return glm::dvec2(static_cast<double>(bits >> 32), static_cast<double>(bits & 0xffffffffU)) * 0x1p-32 - 0.5;
}

/// What one texel along each axis is on a triangle's plane: changes of weights.
using Footprint = std::array<Weights, 2>;

/// A ray that is moved by delta meets the plane at P + delta - d (n . delta) / (n . d).
Footprint footprint(const MaskedTriangle& triangle, const CutoutRays& rays, const glm::dvec3& d, double t) {
  const glm::dvec3 a(triangle.corners[0]), e1 = glm::dvec3(triangle.corners[1]) - a,
                                           e2 = glm::dvec3(triangle.corners[2]) - a, n = glm::cross(e1, e2);
  const double size = glm::dot(n, n);
  Footprint result;
  for (int axis = 0; axis < 2; ++axis) {
    glm::dvec3 delta(0);
    delta[axis] = rays.step[static_cast<std::size_t>(axis)] * (rays.parallel ? 1 : t);
    const glm::dvec3 moved = delta - d * (glm::dot(n, delta) / glm::dot(n, d));
    result[static_cast<std::size_t>(axis)] = {glm::dot(glm::cross(e2, n), moved) / size,
                                              glm::dot(glm::cross(n, e1), moved) / size};
  }
  return result;
}

/// Scales a footprint: to nothing where a texel of the map is no larger than one of the mask, whose edges are
/// then the ray's own; whole from twice that on.
bool narrow(const MaskedTriangle& triangle, const CutoutMask& mask, Footprint& texel) {
  bool any = false;
  const glm::dvec2 size(mask.width, mask.height);
  for (Weights& side : texel) {
    const glm::dvec2 mask_texels = size * (place_at(triangle, side) - triangle.places[0]);
    const double share = std::clamp(glm::length(mask_texels) - 1, 0.0, 1.0);
    side *= share;
    any = any || share > 0;
  }
  return any;
}

/// The point of the surface that stands for all that a map texel sees of it: random, so that the mean over
/// light samples is the share that is there. Where that is beside the triangle, it is the ray's own: then
/// each point of the surface counts alike, up to the triangle's border. Numbers that are not finite are
/// beside it.
Weights point_in_texel(std::uint64_t key, const Footprint& texel, const Weights& centre,
                       const CutoutRays& rays, unsigned lane) {
  const glm::dvec2 offset = random_offset(rays, lane, key);
  const Weights point = centre + offset.x * texel[0] + offset.y * texel[1];
  return is_within(point) ? point : centre;
}

/// A hit as a filter is told of it.
struct FilteredHit {
  FilteredHit(const RTCFilterFunctionNArguments& args, unsigned n)
      : lane(RTCRayN_id(args.ray, args.N, n)),
        triangle(RTCHitN_primID(args.hit, args.N, n)),
        centre(RTCHitN_u(args.hit, args.N, n), RTCHitN_v(args.hit, args.N, n)),
        direction(RTCRayN_dir_x(args.ray, args.N, n), RTCRayN_dir_y(args.ray, args.N, n),
                  RTCRayN_dir_z(args.ray, args.N, n)),
        normal(RTCHitN_Ng_x(args.hit, args.N, n), RTCHitN_Ng_y(args.hit, args.N, n),
               RTCHitN_Ng_z(args.hit, args.N, n)),
        t(RTCRayN_tfar(args.ray, args.N, n)) {}

  unsigned lane;  ///< of the packet that is traced
  unsigned triangle;
  Weights centre;
  glm::dvec3 direction, normal;  ///< of any length
  double t;
};

/// Where in its mask a surface is looked at.
glm::dvec2 place_seen(const CutoutMask& mask, const MaskedTriangle& triangle, std::uint64_t key,
                      const CutoutRays& rays, const FilteredHit& hit) {
  Footprint texel = footprint(triangle, rays, hit.direction, hit.t);
  const bool is_wide = narrow(triangle, mask, texel);
  return place_at(triangle, is_wide ? point_in_texel(key, texel, hit.centre, rays, hit.lane) : hit.centre);
}

/// No point of the texel is farther than this from its centre, in texels of the mask. Seen along d, what is
/// moved across becomes at most |n| |d| / |n . d| times as long on the plane. Infinite or NaN for planes that
/// are seen edge-on.
double reach_in_mask(const CutoutRays& rays, const FilteredHit& hit, double mask_texels_per_metre) {
  const double lengths = glm::length(hit.normal) * glm::length(hit.direction);
  const double facing = std::max(std::abs(glm::dot(hit.normal, hit.direction)) - kRounding * lengths, 0.0);
  const double half_texel = 0.5 * rays.step_across * (rays.parallel ? 1 : hit.t);
  return half_texel * (lengths / facing) * mask_texels_per_metre;
}

bool is_hole(const TracedMesh& traced, const CutoutRays& rays, const FilteredHit& hit) {
  const LightSpaceMesh& mesh = traced.mesh;
  const TracedMesh::Triangle& known = traced.triangles[hit.triangle];
  const MaskedTriangle triangle = masked_triangle(mesh, hit.triangle);
  const double reach = reach_in_mask(rays, hit, static_cast<double>(known.mask_texels_per_metre));
  const MaskPart part = traced.cells->around(place_at(triangle, hit.centre), reach);
  if (part != MaskPart::mixed) return part == MaskPart::hole;
  return !is_solid(*mesh.mask, place_seen(*mesh.mask, triangle, known.key, rays, hit));
}

}  // namespace

CutoutRays::CutoutRays(const MapGrid& grid, const LightSample& sample) : parallel(!grid.perspective()) {
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  const std::array<double, 5> of{sample.position[0], sample.position[1], sample.position[2],
                                 static_cast<double>(sample.jitter[0]),
                                 static_cast<double>(sample.jitter[1])};
  sample_key = XXH3_64bits(of.data(), sizeof of);
  const MapRays rays(grid, sample);
  for (std::size_t axis = 0; axis < 2; ++axis) step[axis] = rays.step(axis);
  step_across = std::hypot(step[0], step[1]);
}

void pass_through_holes(const RTCFilterFunctionNArguments* args) {
  const auto& traced = *static_cast<const TracedMesh*>(args->geometryUserPtr);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    const bool may_pass = (RTCRayN_mask(args->ray, args->N, lane) & kCutoutMask) != 0;
    if (args->valid[lane] != -1 || !may_pass) continue;
    if (is_hole(traced, *reinterpret_cast<const CutoutRays*>(args->context), FilteredHit(*args, lane)))
      args->valid[lane] = 0;
  }
}

double alpha_met(const LightSpaceMesh& mesh, const CutoutRays& rays, const RTCFilterFunctionNArguments& args,
                 unsigned lane) {
  const FilteredHit hit(args, lane);
  const MaskedTriangle triangle = masked_triangle(mesh, hit.triangle);
  return alpha_at(*mesh.mask, place_seen(*mesh.mask, triangle, triangle_key(triangle), rays, hit)) / 255;
}

}  // namespace pdsm
