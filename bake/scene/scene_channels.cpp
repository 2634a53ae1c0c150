// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_channels.h"

#include <algorithm>
#include <cmath>

#include "light/disk_emission.h"

namespace pdsm {
namespace {

const CutoutMask* blending_mask(const Geometry& geometry) {
  return geometry.mesh && geometry.mesh->mask && geometry.mesh->mask->blends ? geometry.mesh->mask.get()
                                                                             : nullptr;
}

/// The mask that lets `transmission` of a channel through besides.
std::shared_ptr<const CutoutMask> channel_mask(const CutoutMask& mask, double transmission, int channel) {
  auto of_channel = std::make_shared<CutoutMask>(mask);
  of_channel->transmission.clear();
  for (std::size_t n = 0; n < mask.alpha.size(); ++n) {
    const double kept = 1 - transmission * mask.transmission[n][channel] / 255.0;
    of_channel->alpha[n] = static_cast<std::uint8_t>(std::lround(kept * mask.alpha[n]));
  }
  return of_channel;
}

bool is_grey(const glm::dvec3& colour) {
  return colour.r == colour.g && colour.g == colour.b;
}

float channel_of(const EmissionImage& image, std::size_t texel, std::uint32_t channel) {
  return image.colour[texel][static_cast<int>(channel)];
}

/// Calls visit(texel, share) for each texel of a light's picture, with the share of it on the light.
template <typename Visit>
void visit_texels(const Light& light, Visit&& visit) {
  std::size_t texel = 0;
  for (std::uint32_t row = 0; row < light.emission->height; ++row)
    for (std::uint32_t column = 0; column < light.emission->width; ++column)
      visit(texel++, share_on_light(light, column, row));
}

double sum_channel(const Light& light, std::uint32_t channel) {
  double sum = 0;
  visit_texels(light, [&](std::size_t texel, double share) {
    sum += share * static_cast<double>(channel_of(*light.emission, texel, channel));
  });
  return sum;
}

/// Between a channel and the luminance, as distributions over the light.
double total_variation(const Light& light, std::uint32_t channel) {
  const EmissionImage& image = *light.emission;
  const double of_channel = sum_channel(light, channel);
  if (of_channel == 0) return 0;
  double of_all = 0, sum = 0;
  visit_texels(light, [&](std::size_t texel, double share) {
    of_all += share * static_cast<double>(image.luminance[texel]);
  });
  visit_texels(light, [&](std::size_t texel, double share) {
    sum += share * std::abs(static_cast<double>(channel_of(image, texel, channel)) / of_channel -
                            static_cast<double>(image.luminance[texel]) / of_all);
  });
  return sum / 2;
}

}  // namespace

bool casts_shadows(const Geometry& geometry) {
  const CutoutMask* mask = blending_mask(geometry);
  const bool is_clear =
      geometry.transmission == glm::dvec3(1) && (mask == nullptr || mask->transmission.empty());
  return geometry.casts && geometry.opacity != 0 && !is_clear;
}

bool is_translucent_caster(const Geometry& geometry) {
  return casts_shadows(geometry) && (geometry.opacity != 1 || geometry.transmission != glm::dvec3(0) ||
                                     blending_mask(geometry) != nullptr);
}

bool is_coloured_caster(const Geometry& geometry) {
  if (!casts_shadows(geometry)) return false;
  const CutoutMask* mask = blending_mask(geometry);
  if (mask == nullptr || mask->transmission.empty()) return !is_grey(geometry.transmission);
  const auto has_hue = [&](const glm::u8vec3& share) {
    return !is_grey(geometry.transmission * glm::dvec3(share));
  };
  return std::ranges::any_of(mask->transmission, has_hue);
}

Geometry channel_geometry(const Geometry& geometry, std::uint32_t channel) {
  Geometry of_channel = geometry;
  if (geometry.transmission == glm::dvec3(0)) return of_channel;
  of_channel.transmission = glm::dvec3(0);
  const auto index = static_cast<int>(channel);
  const double transmission = geometry.transmission[index];
  const CutoutMask* mask = blending_mask(geometry);
  if (mask == nullptr || mask->transmission.empty()) {
    of_channel.opacity *= 1 - transmission;
    return of_channel;
  }
  auto mesh = std::make_shared<Mesh>(*geometry.mesh);
  mesh->mask = channel_mask(*mask, transmission, index);
  of_channel.mesh = std::move(mesh);
  return of_channel;
}

Scene channel_scene(const Scene& scene, std::uint32_t channel) {
  Scene of_channel;
  of_channel.source = scene.source;
  of_channel.volumes = scene.volumes;
  of_channel.curves = scene.curves;
  for (const Geometry& geometry : scene.geometry)
    of_channel.geometry.push_back(channel_geometry(geometry, channel));
  return of_channel;
}

bool is_coloured(const Light& light) {
  constexpr double kHalfStep = 1.0 / 510;
  if (!light.emission || light.emission->colour.empty()) return false;
  for (std::uint32_t channel = 0; channel < kColourChannels; ++channel)
    if (total_variation(light, channel) > kHalfStep) return true;
  return false;
}

Light channel_light(const Light& light, std::uint32_t channel) {
  if (!is_coloured(light)) return light;
  Light of_channel = light;
  auto image = std::make_shared<EmissionImage>();
  image->width = light.emission->width;
  image->height = light.emission->height;
  image->luminance = light.emission->luminance;
  if (sum_channel(light, channel) > 0)
    for (std::size_t n = 0; n < image->luminance.size(); ++n)
      image->luminance[n] = channel_of(*light.emission, n, channel);
  of_channel.emission = std::move(image);
  return of_channel;
}

bool may_be_coloured(const Scene& scene, const Light& light) {
  return is_coloured(light) || std::ranges::any_of(scene.geometry, is_coloured_caster);
}

}  // namespace pdsm
