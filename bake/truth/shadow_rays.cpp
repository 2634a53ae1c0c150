// SPDX-License-Identifier: Apache-2.0
#include "truth/shadow_rays.h"

#include <algorithm>

#include "scene/scene_channels.h"
#include "truth/random.h"

namespace pdsm {
namespace {

/// A picture as it is seen from behind.
std::shared_ptr<const EmissionImage> mirrored(const EmissionImage& image) {
  auto result = std::make_shared<EmissionImage>(image);
  for (std::size_t row = 0; row < image.height; ++row) {
    const auto reverse_row = [&](auto& values) {
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(row * image.width);
      std::reverse(begin, begin + image.width);
    };
    reverse_row(result->luminance);
    if (!result->colour.empty()) reverse_row(result->colour);
  }
  return result;
}

/// The light turned round its y axis, with what it emits where it was.
Light turned_round(const Light& light) {
  Light turned = light;
  const auto& r = light_frame(light).rotation;
  turned.direction = -glm::dvec3(r[6], r[7], r[8]);
  turned.up = glm::dvec3(r[3], r[4], r[5]);
  if (light.emission) turned.emission = mirrored(*light.emission);
  return turned;
}

}  // namespace

ShadowRays::ShadowRays(const Scene& scene, const Light& light, double near_depth)
    : world_to_light_(light_frame(light)), channels_(make_channels(scene, light, near_depth)) {
  if (light.two_sided) behind_ = make_channels(scene, turned_round(light), near_depth);
}

ShadowRays::Channels ShadowRays::make_channels(const Scene& scene, const Light& light,
                                               double near_depth) const {
  std::ranges::for_each(scene.geometry, check_opacity);
  Channels channels;
  const std::uint32_t count = may_be_coloured(scene, light) ? kColourChannels : 1;
  for (std::uint32_t channel = 0; channel < count; ++channel)
    channels.push_back(std::make_unique<const ChannelRays>(channel_scene(scene, channel),
                                                           channel_light(light, channel), near_depth));
  return channels;
}

const ShadowRays::Channels& ShadowRays::channels_at(const glm::dvec3& world_point) const {
  return !behind_.empty() && apply(world_to_light_, world_point).z < 0 ? behind_ : channels_;
}

template <typename OfChannel>
std::array<double, 3> ShadowRays::each(const Channels& channels, const OfChannel& of_channel) {
  std::array<double, 3> values{};
  values.fill(of_channel(*channels.front()));
  for (std::size_t channel = 1; channel < channels.size(); ++channel)
    values[channel] = of_channel(*channels[channel]);
  return values;
}

double ShadowRays::attenuation(const glm::dvec3& world_point, std::uint32_t samples,
                               std::uint64_t seed) const {
  return brightness(rgb(world_point, samples, seed));
}

std::array<double, 3> ShadowRays::rgb(const glm::dvec3& world_point, std::uint32_t samples,
                                      std::uint64_t seed) const {
  return each(channels_at(world_point),
              [&](const ChannelRays& rays) { return rays.attenuation(world_point, samples, seed); });
}

std::array<double, 3> ShadowRays::model_rgb(const glm::dvec3& world_point, std::uint32_t samples,
                                            std::uint64_t seed) const {
  return each(channels_,
              [&](const ChannelRays& rays) { return rays.model_attenuation(world_point, samples, seed); });
}

double ShadowRays::attenuation(const glm::dvec3& world_point, std::span<const LightPoint> light_points,
                               const CasterBias* bias) const {
  return brightness(each(
      channels_, [&](const ChannelRays& rays) { return rays.attenuation(world_point, light_points, bias); }));
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
