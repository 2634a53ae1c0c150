// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "pdsm/bake/scene.h"
#include "truth/caster_bias.h"
#include "truth/channel_rays.h"
#include "truth/light_points.h"

namespace pdsm {

/// Attenuation by shadow rays: the truth that maps are measured against. It shares no visibility code and
/// no light samples with the baker. All casters of the scene block, window or not, but for their holes;
/// translucent ones let their share of each ray through, surface by surface, and volumes theirs. Red, green
/// and blue are traced each for itself where they may differ. Any thread.
class ShadowRays {
 public:
  /// `near_depth` (metres, light space): geometry at or behind 1e-4 of it belongs to the emitter and never
  /// blocks; all blocks before a distant light, and around a sphere light up to its surface. Throws Error as
  /// light_frame() does, or (resource) when Embree fails.
  ShadowRays(const Scene& scene, const Light& light, double near_depth);

  /// Whether channels may differ.
  [[nodiscard]] bool is_coloured() const { return channels_.size() > 1; }

  /// Share of the light of `samples` (>= 1) light points that casters keep from `world_point` (metres); 0
  /// behind the light unless it is two-sided, and within a sphere or a closed mesh light. Of those, what the
  /// point sees of it counts, by solid angle. Rays leave the point at 1e-4 of the distance to the light
  /// point, or to where a distant light's space begins. A pure function of its arguments. Of three channels
  /// how bright they are together, as a look-up tells it.
  [[nodiscard]] double attenuation(const glm::dvec3& world_point, std::uint32_t samples,
                                   std::uint64_t seed) const;

  /// The same of red, green and blue.
  [[nodiscard]] std::array<double, 3> rgb(const glm::dvec3& world_point, std::uint32_t samples,
                                          std::uint64_t seed) const;

  /// The same with the baker's model of a sphere or mesh light, which this must be, in its place
  /// (light_points.h, mesh_emitter.h).
  [[nodiscard]] std::array<double, 3> model_rgb(const glm::dvec3& world_point, std::uint32_t samples,
                                                std::uint64_t seed) const;

  /// attenuation() of many points on all threads. Point n takes the seed hash_bits(seed, n), or with
  /// `same_seed` all take `seed`. The result does not depend on the number of threads.
  [[nodiscard]] std::vector<double> attenuations(std::span<const glm::dvec3> world_points,
                                                 std::uint32_t samples, std::uint64_t seed,
                                                 bool same_seed = false) const;
  /// rgb() of many points.
  [[nodiscard]] std::vector<std::array<double, 3>> rgbs(std::span<const glm::dvec3> world_points,
                                                        std::uint32_t samples, std::uint64_t seed,
                                                        bool same_seed = false) const;

  /// Share of the light of the given light points (1 or more) that casters keep from `world_point`; 0 behind
  /// the light, two-sided or not. With `bias`, a caster hides nothing from points as near behind it, in
  /// depth, as its bias.
  [[nodiscard]] double attenuation(const glm::dvec3& world_point, std::span<const LightPoint> light_points,
                                   const CasterBias* bias = nullptr) const;

 private:
  /// One where all are the same.
  using Channels = std::vector<std::unique_ptr<const ChannelRays>>;

  [[nodiscard]] Channels make_channels(const Scene& scene, const Light& light, double near_depth) const;
  template <typename OfChannel>
  [[nodiscard]] static std::array<double, 3> each(const Channels& channels, const OfChannel& of_channel);
  /// Those of the side that the point is on.
  [[nodiscard]] const Channels& channels_at(const glm::dvec3& world_point) const;

  RigidTransform world_to_light_;
  Channels channels_;
  Channels behind_;  ///< of a two-sided light turned round; else empty
};

/// How bright the channels are together (Rec. 709).
[[nodiscard]] double brightness(const std::array<double, 3>& rgb);

}  // namespace pdsm
