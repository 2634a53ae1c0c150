// SPDX-License-Identifier: Apache-2.0
#include "evaluate/window_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluate/heat_map.h"
#include "evaluate/last_receivers.h"
#include "pdsm/runtime/look_up.h"
#include "truth/random.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// One value a texel, rows turned over: pictures begin on top, maps at y0.
template <typename ValueOf>
std::vector<float> from_top(std::uint32_t width, std::uint32_t height, std::span<const TexelError> errors,
                            const ValueOf& value_of) {
  std::vector<float> values;
  values.reserve(errors.size());
  for (std::uint32_t row = height; row-- > 0;) {
    for (std::uint32_t i = 0; i < width; ++i)
      values.push_back(value_of(errors[std::size_t{row} * width + i]));
  }
  return values;
}

}  // namespace

std::vector<TexelError> measure_texels(const PenumbraMap& map, const Scene& scene, const Light& light,
                                       std::span<const std::array<std::uint32_t, 2>> texels,
                                       std::uint32_t samples, std::uint64_t seed,
                                       std::uint32_t index_of_view) {
  const View& view = map.views[index_of_view];
  const LastReceivers receivers(scene, view);
  const ShadowRays rays(scene, light, map.views.front().near_depth);
  const PenumbraLookUp look_up(map);
  std::vector<TexelError> errors(texels.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t n = 0; n < texels.size(); ++n) {
    const std::optional<glm::dvec3> point = receivers.find(texels[n]);
    if (!point) {
      errors[n] = {kNothing, kNothing};
      continue;
    }
    const std::uint64_t index = std::uint64_t{texels[n][1]} * view.width + texels[n][0];
    const double truth = rays.attenuation(*point, samples, hash_bits(seed, index));
    const float value = look_up.at({point->x, point->y, point->z}, Filter::bilinear).attenuation;
    errors[n] = {static_cast<float>(static_cast<double>(value) - truth), static_cast<float>(truth)};
  }
  return errors;
}

std::vector<std::array<std::uint32_t, 2>> all_texels(const View& view) {
  std::vector<std::array<std::uint32_t, 2>> texels;
  texels.reserve(std::size_t{view.width} * view.height);
  for (std::uint32_t j = 0; j < view.height; ++j) {
    for (std::uint32_t i = 0; i < view.width; ++i) texels.push_back({i, j});
  }
  return texels;
}

std::vector<std::array<std::uint32_t, 2>> draw_texels(const View& view, std::uint32_t count,
                                                      std::uint64_t seed) {
  std::vector<std::array<std::uint32_t, 2>> texels;
  for (std::uint32_t n = 0; n < count; ++n) {
    const std::array<double, 2> unit = hash_unit_pair(seed, n);
    texels.push_back({static_cast<std::uint32_t>(unit[0] * view.width),
                      static_cast<std::uint32_t>(unit[1] * view.height)});
  }
  return texels;
}

double atty_error(std::span<const TexelError> errors) {
  double sum = 0, shadowed = 0;
  for (const TexelError& texel : errors) {
    if (std::isnan(texel.error)) continue;
    sum += std::abs(static_cast<double>(texel.error));
    shadowed += texel.truth > 0 ? 1 : 0;
  }
  return sum / std::max(1.0, shadowed);
}

RgbImage draw_window_errors(std::uint32_t width, std::uint32_t height, std::span<const TexelError> errors) {
  const auto magnitude = [](const TexelError& t) { return std::isnan(t.error) ? -1.0F : std::abs(t.error); };
  const auto light = [](const TexelError& t) { return std::isnan(t.truth) ? 0.0F : 1 - t.truth; };
  const std::vector<float> values = from_top(width, height, errors, magnitude);
  const float most = std::max(0.0F, *std::max_element(values.begin(), values.end()));
  const std::string title = fmt::format("mean {:.3g}  max {:.3g}", atty_error(errors), most);
  return draw_heat_map(width, height, values, from_top(width, height, errors, light), title);
}

FloatPlane window_error_plane(std::uint32_t width, std::uint32_t height, std::span<const TexelError> errors) {
  return {"Y", from_top(width, height, errors, [](const TexelError& t) { return t.error; })};
}

}  // namespace pdsm
