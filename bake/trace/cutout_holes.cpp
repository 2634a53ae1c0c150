// SPDX-License-Identifier: Apache-2.0
#include "trace/cutout_holes.h"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "trace/embree_scene.h"
#include "trace/map_rays.h"
#include "trace/mask_alpha.h"

namespace pdsm {
namespace {

/// A point of a triangle, by the weights of its second and third corner.
using Weights = glm::dvec2;

bool is_within(const Weights& w) {
  return w.x >= 0 && w.y >= 0 && w.x + w.y <= 1;
}

struct MaskedTriangle {
  std::array<glm::vec3, 3> corners;
  std::array<glm::dvec2, 3> places;

  [[nodiscard]] glm::dvec2 place_at(const Weights& w) const {
    return places[0] + w.x * (places[1] - places[0]) + w.y * (places[2] - places[0]);
  }
};

MaskedTriangle masked_triangle(const LightSpaceMesh& mesh, unsigned triangle) {
  MaskedTriangle result;
  for (int n = 0; n < 3; ++n) {
    const std::uint32_t corner = mesh.triangles[triangle][n];
    result.corners[static_cast<std::size_t>(n)] = mesh.positions[corner];
    result.places[static_cast<std::size_t>(n)] = glm::dvec2(mesh.mask_places[corner]);
  }
  return result;
}

/// The same for a triangle and its copies, however wound and wherever in the scene: two sides of one leaf
/// have the same holes.
std::uint64_t triangle_key(const MaskedTriangle& triangle) {
  std::uint64_t key = 0;
  for (const glm::vec3& corner : triangle.corners) {
    const glm::vec3 unsigned_zeros = corner + 0.0F;
    key += XXH3_64bits(&unsigned_zeros, sizeof unsigned_zeros);
  }
  return key;
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
    const glm::dvec2 mask_texels = size * (triangle.place_at(side) - triangle.places[0]);
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
Weights point_in_texel(const MaskedTriangle& triangle, const Footprint& texel, const Weights& centre,
                       const CutoutRays& rays, unsigned lane) {
  const glm::dvec2 offset = random_offset(rays, lane, triangle_key(triangle));
  const Weights point = centre + offset.x * texel[0] + offset.y * texel[1];
  return is_within(point) ? point : centre;
}

/// Where in its mask a surface is looked at.
glm::dvec2 place_seen(const LightSpaceMesh& mesh, const CutoutRays& rays,
                      const RTCFilterFunctionNArguments& args, unsigned lane) {
  const unsigned n = args.N;
  const MaskedTriangle triangle = masked_triangle(mesh, RTCHitN_primID(args.hit, n, lane));
  const Weights centre(RTCHitN_u(args.hit, n, lane), RTCHitN_v(args.hit, n, lane));
  const glm::dvec3 d(RTCRayN_dir_x(args.ray, n, lane), RTCRayN_dir_y(args.ray, n, lane),
                     RTCRayN_dir_z(args.ray, n, lane));
  Footprint texel = footprint(triangle, rays, d, static_cast<double>(RTCRayN_tfar(args.ray, n, lane)));
  const Weights point = narrow(triangle, *mesh.mask, texel)
                            ? point_in_texel(triangle, texel, centre, rays, RTCRayN_id(args.ray, n, lane))
                            : centre;
  return triangle.place_at(point);
}

bool is_hole(const LightSpaceMesh& mesh, const CutoutRays& rays, const RTCFilterFunctionNArguments& args,
             unsigned lane) {
  return !is_solid(*mesh.mask, place_seen(mesh, rays, args, lane));
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
}

void pass_through_holes(const RTCFilterFunctionNArguments* args) {
  const auto& mesh = *static_cast<const LightSpaceMesh*>(args->geometryUserPtr);
  for (unsigned lane = 0; lane < args->N; ++lane) {
    const bool may_pass = (RTCRayN_mask(args->ray, args->N, lane) & kCutoutMask) != 0;
    if (args->valid[lane] != -1 || !may_pass) continue;
    if (is_hole(mesh, *reinterpret_cast<const CutoutRays*>(args->context), *args, lane))
      args->valid[lane] = 0;
  }
}

double alpha_met(const LightSpaceMesh& mesh, const CutoutRays& rays, const RTCFilterFunctionNArguments& args,
                 unsigned lane) {
  return alpha_at(*mesh.mask, place_seen(mesh, rays, args, lane)) / 255;
}

}  // namespace pdsm
