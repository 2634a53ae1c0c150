// SPDX-License-Identifier: Apache-2.0
#include "choose/settings.h"

#include <fmt/format.h>

namespace pdsm {

namespace {

std::uint32_t maps_per_texel(const BakeOptions& options) {
  if (options.map_width == 0 && options.map_height == 0) return 1;
  for (const std::uint32_t scale : {1U, 2U}) {
    if (options.map_width == scale * options.width && options.map_height == scale * options.height)
      return scale;
  }
  return 0;
}

}  // namespace

Settings settings_of(const BakeOptions& options) {
  return {options.samples, options.width, options.height, options.epsilon, maps_per_texel(options)};
}

BakeOptions with_settings(BakeOptions options, const Settings& settings) {
  options.samples = settings.samples;
  options.width = settings.width;
  options.height = settings.height;
  options.epsilon = settings.epsilon;
  if (settings.maps_per_texel != 0) {
    options.map_width = settings.maps_per_texel * settings.width;
    options.map_height = settings.maps_per_texel * settings.height;
  }
  return options;
}

std::string settings_text(const Settings& settings) {
  return fmt::format("{} samples, {} x {} texels{}, epsilon {:.3g}", settings.samples, settings.width,
                     settings.height, settings.maps_per_texel == 2 ? ", maps twice as fine" : "",
                     settings.epsilon);
}

}  // namespace pdsm
