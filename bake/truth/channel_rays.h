// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"
#include "truth/caster_bias.h"
#include "truth/light_points.h"
#include "truth/mesh_emitter.h"
#include "truth/translucent_surfaces.h"
#include "truth/volume_shadows.h"
#include "truth/world_scene.h"

namespace pdsm {

/// Shadow rays of one channel, of a scene and a light that know no colour (scene/scene_channels.h); see
/// ShadowRays. Any thread.
class ChannelRays {
 public:
  /// As ShadowRays.
  ChannelRays(const Scene& scene, const Light& light, double near_depth);

  [[nodiscard]] double attenuation(const glm::dvec3& world_point, std::uint32_t samples,
                                   std::uint64_t seed) const;

  [[nodiscard]] double model_attenuation(const glm::dvec3& world_point, std::uint32_t samples,
                                         std::uint64_t seed) const;

  [[nodiscard]] double attenuation(const glm::dvec3& world_point, std::span<const LightPoint> light_points,
                                   const CasterBias* bias = nullptr) const;

 private:
  struct Packet;
  struct WeightedPoint;
  struct RayContext;
  /// Share of the light of light points 0 .. count - 1 that is kept off; `light_point(n)` makes them.
  template <typename MakePoint>
  [[nodiscard]] double share_blocked(const glm::dvec3& world_point, std::uint32_t count,
                                     const MakePoint& light_point, const CasterBias* bias) const;
  void add_ray(const WeightedPoint& drawn, Packet& packet) const;
  /// Whether the light shines on a point, light space.
  [[nodiscard]] bool is_lit_side(const glm::dvec3& p) const;
  /// What volumes leave of a packet's ray.
  [[nodiscard]] double left_by_volumes(const Packet& packet, std::uint32_t lane) const;
  /// The sum of what casters take of a packet's rays.
  [[nodiscard]] double sum_blocked(const Packet& packet, const CasterBias* bias) const;

  LightSurface light_;
  RigidTransform world_to_light_, light_to_world_;
  bool distant_;
  std::optional<double> sphere_radius_;
  std::unique_ptr<const MeshEmitter> emitter_;  ///< of a mesh light
  double emitter_depth_;                        ///< light-space z up to which nothing blocks
  WorldScene casters_;
  unsigned curve_ids_;  ///< the first, of the casters
  TranslucentSurfaces translucent_;
  VolumeShadows volumes_;
};

}  // namespace pdsm
