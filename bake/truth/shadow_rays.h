// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"
#include "truth/caster_bias.h"
#include "truth/light_points.h"
#include "truth/translucent_surfaces.h"
#include "truth/volume_shadows.h"
#include "truth/world_scene.h"

namespace pdsm {

/// Attenuation by shadow rays: the truth that maps are measured against. It shares no visibility code and
/// no light samples with the baker. All casters of the scene block, window or not, but for their holes;
/// translucent ones let their share of each ray through, surface by surface, and volumes theirs.
class ShadowRays {
 public:
  /// `near_depth` (metres, light space): geometry at or behind 1e-4 of it belongs to the emitter and never
  /// blocks; all blocks before a distant light, and around a sphere light up to its surface. Throws Error as
  /// light_frame() does, or (resource) when Embree fails.
  ShadowRays(const Scene& scene, const Light& light, double near_depth);

  /// Share of the light of `samples` (>= 1) light points that casters keep from `world_point` (metres); 0
  /// behind the light, and within a sphere light. Of that, what the point sees of it counts, by solid angle.
  /// Rays leave the point at 1e-4 of the distance to the light point, or to where a distant light's space
  /// begins. A pure function of its arguments; any thread.
  [[nodiscard]] double attenuation(const glm::dvec3& world_point, std::uint32_t samples,
                                   std::uint64_t seed) const;

  /// The same with the baker's model of a sphere light in place of the sphere (light_points.h), of a radius
  /// that this light must have.
  [[nodiscard]] double model_attenuation(const glm::dvec3& world_point, std::uint32_t samples,
                                         std::uint64_t seed) const;

  /// Of many points on all threads. Point n takes the seed hash_bits(seed, n), or with `same_seed` all take
  /// `seed`. The result does not depend on the number of threads.
  [[nodiscard]] std::vector<double> attenuations(std::span<const glm::dvec3> world_points,
                                                 std::uint32_t samples, std::uint64_t seed,
                                                 bool same_seed = false) const;

  /// Share of the light of the given light points (1 or more) that casters keep from `world_point`; 0 behind
  /// the light. With `bias`, a caster hides nothing from points as near behind it, in depth, as its bias.
  [[nodiscard]] double attenuation(const glm::dvec3& world_point, std::span<const LightPoint> light_points,
                                   const CasterBias* bias = nullptr) const;

 private:
  struct Packet;
  struct RayContext;
  /// Share of the light of light points 0 .. count - 1 that is kept off; `light_point(n)` makes them.
  template <typename MakePoint>
  [[nodiscard]] double share_blocked(const glm::dvec3& world_point, std::uint32_t count,
                                     const MakePoint& light_point, const CasterBias* bias) const;
  void add_ray(const LightPoint& point, Packet& packet) const;
  /// What volumes leave of a packet's ray.
  [[nodiscard]] double left_by_volumes(const Packet& packet, std::uint32_t lane) const;
  /// The sum of what casters take of a packet's rays.
  [[nodiscard]] double sum_blocked(const Packet& packet, const CasterBias* bias) const;

  LightSurface light_;
  RigidTransform world_to_light_, light_to_world_;
  bool distant_;
  std::optional<double> sphere_radius_;
  double emitter_depth_;  ///< light-space z up to which nothing blocks
  WorldScene casters_;
  TranslucentSurfaces translucent_;
  VolumeShadows volumes_;
};

}  // namespace pdsm
