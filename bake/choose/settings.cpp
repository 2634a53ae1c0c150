// SPDX-License-Identifier: Apache-2.0
#include "choose/settings.h"

#include <fmt/format.h>

namespace pdsm {

Settings settings_of(const BakeOptions& options) {
  return {options.samples, options.width, options.height, options.epsilon};
}

BakeOptions with_settings(BakeOptions options, const Settings& settings) {
  options.samples = settings.samples;
  options.width = settings.width;
  options.height = settings.height;
  options.epsilon = settings.epsilon;
  return options;
}

std::string settings_text(const Settings& settings) {
  return fmt::format("{} samples, {} x {} texels, epsilon {:.3g}", settings.samples, settings.width,
                     settings.height, settings.epsilon);
}

}  // namespace pdsm
