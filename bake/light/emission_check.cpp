// SPDX-License-Identifier: Apache-2.0
#include "light/emission_check.h"

#include <algorithm>
#include <cmath>

#include "pdsm/format/error.h"

namespace pdsm {

const char* emission_fault(const EmissionImage& image) {
  const auto fits = [](std::uint32_t texels) { return texels >= 1 && texels <= kMostEmissionTexels; };
  if (!fits(image.width) || !fits(image.height) ||
      image.luminance.size() != std::size_t{image.width} * image.height)
    return "must have as many values as its width and height say, at most 8192 along an axis";
  if (!std::ranges::all_of(image.luminance, [](float x) { return std::isfinite(x) && x >= 0; }))
    return "must be finite and not negative";
  if (std::ranges::all_of(image.luminance, [](float x) { return x == 0; })) return "is black";
  const auto is_emission = [](const glm::vec3& rgb) {
    return std::isfinite(rgb.r + rgb.g + rgb.b) && rgb.r >= 0 && rgb.g >= 0 && rgb.b >= 0;
  };
  if (!image.colour.empty() && image.colour.size() != image.luminance.size())
    return "must have as many colours as values of luminance";
  if (!std::ranges::all_of(image.colour, is_emission)) return "must have colours that are not negative";
  return nullptr;
}

void check_emission(const Light& light) {
  if (!light.emission) return;
  const char* fault = std::holds_alternative<RectLight>(light.shape)
                          ? emission_fault(*light.emission)
                          : "of lights that are not rect: not supported yet";
  if (fault != nullptr) throw Error(Failure::input, light.name + ".emission", fault);
}

}  // namespace pdsm
