// SPDX-License-Identifier: Apache-2.0
#include "truth/shadow_rays.h"

#include <algorithm>

#include "scene/scene_channels.h"
#include "truth/random.h"

namespace pdsm {

ShadowRays::ShadowRays(const Scene& scene, const Light& light, double near_depth) {
  std::ranges::for_each(scene.geometry, check_opacity);
  const bool coloured = may_be_coloured(scene, light);
  for (std::uint32_t channel = 0; channel < (coloured ? kColourChannels : 1); ++channel)
    channels_.push_back(std::make_unique<const ChannelRays>(channel_scene(scene, channel),
                                                            channel_light(light, channel), near_depth));
}

template <typename OfChannel>
std::array<double, 3> ShadowRays::each(const OfChannel& of_channel) const {
  std::array<double, 3> values{};
  values.fill(of_channel(*channels_.front()));
  for (std::size_t channel = 1; channel < channels_.size(); ++channel)
    values[channel] = of_channel(*channels_[channel]);
  return values;
}

double ShadowRays::attenuation(const glm::dvec3& world_point, std::uint32_t samples,
                               std::uint64_t seed) const {
  return brightness(rgb(world_point, samples, seed));
}

std::array<double, 3> ShadowRays::rgb(const glm::dvec3& world_point, std::uint32_t samples,
                                      std::uint64_t seed) const {
  return each([&](const ChannelRays& rays) { return rays.attenuation(world_point, samples, seed); });
}

std::array<double, 3> ShadowRays::model_rgb(const glm::dvec3& world_point, std::uint32_t samples,
                                            std::uint64_t seed) const {
  return each([&](const ChannelRays& rays) { return rays.model_attenuation(world_point, samples, seed); });
}

double ShadowRays::attenuation(const glm::dvec3& world_point, std::span<const LightPoint> light_points,
                               const CasterBias* bias) const {
  return brightness(
      each([&](const ChannelRays& rays) { return rays.attenuation(world_point, light_points, bias); }));
}

std::vector<double> ShadowRays::attenuations(std::span<const glm::dvec3> world_points, std::uint32_t samples,
                                             std::uint64_t seed, bool same_seed) const {
  std::vector<double> result;
  result.reserve(world_points.size());
  for (const auto& of_point : rgbs(world_points, samples, seed, same_seed))
    result.push_back(brightness(of_point));
  return result;
}

std::vector<std::array<double, 3>> ShadowRays::rgbs(std::span<const glm::dvec3> world_points,
                                                    std::uint32_t samples, std::uint64_t seed,
                                                    bool same_seed) const {
  std::vector<std::array<double, 3>> result(world_points.size());
  const auto count = static_cast<std::int64_t>(world_points.size());
#pragma omp parallel for schedule(dynamic, 8)
  for (std::int64_t i = 0; i < count; ++i) {
    const auto n = static_cast<std::size_t>(i);
    result[n] = rgb(world_points[n], samples, same_seed ? seed : hash_bits(seed, n));
  }
  return result;
}

double brightness(const std::array<double, 3>& rgb) {
  // Of equal channels exactly what each is.
  return rgb[1] + 0.2126 * (rgb[0] - rgb[1]) + 0.0722 * (rgb[2] - rgb[1]);
}

}  // namespace pdsm
