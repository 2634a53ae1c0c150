// SPDX-License-Identifier: Apache-2.0
#include "light/emission_check.h"

#include <algorithm>
#include <cmath>

#include "light/disk_emission.h"
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

const char* emission_fault(const Light& light) {
  if (std::holds_alternative<RectLight>(light.shape)) return nullptr;
  if (!std::holds_alternative<DiskLight>(light.shape)) return "must be of a rect or disk light";
  const EmissionImage& image = *light.emission;
  for (std::uint32_t row = 0; row < image.height; ++row)
    for (std::uint32_t column = 0; column < image.width; ++column)
      if (image.luminance[std::size_t{row} * image.width + column] > 0 &&
          share_on_light(light, column, row) > 0)
        return nullptr;
  return "is black on the disk";
}

void check_emission(const Light& light) {
  if (!light.emission) return;
  const char* fault = emission_fault(*light.emission);
  if (fault == nullptr) fault = emission_fault(light);
  if (fault != nullptr) throw Error(Failure::input, light.name + ".emission", fault);
}

}  // namespace pdsm
