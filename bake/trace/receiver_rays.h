// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include "trace/embree_scene.h"
#include "walk/map_grid.h"

/// Rays that meet light-facing receiver surfaces.
namespace pdsm {

enum class Heading { to_light, from_light };

/// A ray from the point at `start` metres of depth on the PDSM ray to the light, by falling depth.
struct RayToLight {
  glm::vec3 origin, direction;
};
[[nodiscard]] RayToLight ray_to_light(const CentralRay& ray, double start);

/// A context whose filter rejects surfaces of closed meshes that face away from the light.
struct ReceiverContext {
  explicit ReceiverContext(Heading heading);
  RTCIntersectContext context;
};

/// Depth from which rays to the light start: a little behind far, so that a surface at far is met.
[[nodiscard]] double receiver_ray_start(const MapGrid& grid);

/// The plane of a triangle on the PDSM ray `ray` of `grid`.
struct PlaneOnRay {
  double depth = 0;                 ///< metres
  double slope_u = 0, slope_v = 0;  ///< change of depth per change of slope, metres
};
[[nodiscard]] PlaneOnRay plane_on_ray(const LightSpaceMesh& mesh, unsigned triangle, const MapGrid& grid,
                                      const CentralRay& ray);

/// The plane's depth, unless the triangle is so grazing that only the traced one makes sense.
[[nodiscard]] double surface_depth(const MapGrid& grid, const PlaneOnRay& plane, double traced_depth);

}  // namespace pdsm
