// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "choose/laws.h"

namespace pdsm {

/// Trials of a light whose laws are known: no bake is made.
struct KnownLaws {
  double sampling = 0.1, resolution = 2, fit = 0.2, resolution_power = 0.8;

  [[nodiscard]] double error(const Settings& s) const {
    return sampling * std::pow(s.samples, -0.75) + resolution * std::pow(s.edge(), -resolution_power) +
           fit * s.epsilon;
  }
  [[nodiscard]] static double bytes(const Settings& s) {
    return 3 * std::pow(s.samples, -0.25) * std::pow(s.edge(), 1.9) / s.epsilon;
  }
  [[nodiscard]] static double seconds(const Settings& s) { return 0.5 + 1e-8 * s.work(); }

  [[nodiscard]] Trial trial(const Settings& s) const {
    Trial trial;
    trial.settings = s;
    trial.error.mean_abs_error = error(s);
    trial.bytes = static_cast<std::uint64_t>(std::llround(bytes(s)));
    trial.seconds_bake = seconds(s);
    return trial;
  }
  [[nodiscard]] StarTrials star(const Settings& base) const {
    return {trial(base), trial(with_more_samples(base)), trial(with_finer_texels(base)),
            trial(with_looser_fit(base))};
  }
};

}  // namespace pdsm
