// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "choose/laws.h"
#include "choose/search.h"
#include "pdsm/format/error.h"

namespace pdsm {

/// Trials of a light whose laws are known: no bake is made.
struct KnownLaws {
  double sampling = 0.1, resolution = 2, fit = 0.2, resolution_power = 0.8;
  double finer_maps = 0.75;  ///< of the resolution part
  double bend =
      std::numeric_limits<double>::infinity();  ///< edge beyond which it falls with 0.4 of the power
  double scatter = 0;      ///< standard error at one point, where the resolution part is 1
  double most_edge = 1e9;  ///< texels that memory allows

  [[nodiscard]] double sampling_error(const Settings& s) const {
    return sampling * std::pow(s.samples, -0.75);
  }
  [[nodiscard]] double resolution_error(const Settings& s) const {
    const double bent = std::pow(std::max(1.0, s.edge() / bend), 0.6 * resolution_power);
    return resolution * std::pow(s.edge(), -resolution_power) * bent *
           (s.maps_per_texel == 2 ? finer_maps : 1);
  }
  [[nodiscard]] double error(const Settings& s) const {
    return resolution_error(s) + std::hypot(sampling_error(s), fit * s.epsilon);
  }
  [[nodiscard]] static double bytes(const Settings& s) {
    return 3 * std::pow(s.samples, -0.25) * std::pow(s.edge(), 1.9) / s.epsilon *
           (s.maps_per_texel == 2 ? 1.05 : 1);
  }
  [[nodiscard]] static double seconds(const Settings& s) { return 0.5 + 1e-8 * s.work(); }

  [[nodiscard]] Trial trial(const Settings& s) const {
    Trial trial;
    trial.settings = s;
    trial.error.mean_abs_error = error(s);
    trial.sampling_error = sampling_error(s);
    trial.bytes = static_cast<std::uint64_t>(std::llround(bytes(s)));
    trial.seconds_bake = seconds(s);
    // Of two fits that err independently the change is the hypotenuse; here, at one point, a difference.
    trial.error.shadowed_points = 1;
    trial.looked_up = {std::hypot(1, kStarEpsilon) / (kStarEpsilon - 1) * fit * s.epsilon};
    return trial;
  }
  [[nodiscard]] StarTrials star(const Settings& base) const {
    StarTrials star;
    star.base = trial(base);
    star.more_samples = trial(with_more_samples(base));
    star.finer = trial(with_finer_texels(base));
    star.looser = trial(with_looser_fit(base));
    star.finer_maps = trial(with_finer_maps(base));
    star.fit_change = mean_change(star.base, star.looser);
    return star;
  }

  /// Measured as a bake is: the points of a seed all see the same share of the scatter, +-1 standard error
  /// in turn.
  [[nodiscard]] TrialBake run(const std::string& purpose, const Settings& s,
                              const VerifyOptions& measure) const {
    if (s.edge() > most_edge) throw Error(Failure::resource, "--memory", "too little");
    TrialBake result;
    Trial& trial = result.trial = this->trial(s);
    trial.purpose = purpose;
    trial.error.points = measure.points;
    // What resolution errs by is much at few points; sampling and fit err everywhere.
    trial.standard_error = scatter * std::pow(resolution_error(s), 2.0 / 3) / std::sqrt(measure.points);
    trial.error.mean_abs_error += (measure.seed % 2 == 0 ? -1 : 1) * trial.standard_error;
    trial.seconds_measure = 1e-8 * measure.points * measure.samples;
    return result;
  }
  [[nodiscard]] ChosenBake search(const Goals& goals, const FixedOptions& fixed = {},
                                  const BakeOptions& options = {}) const {
    return pdsm::search({options, fixed, goals, 1},
                        [this](const std::string& purpose, const Settings& s, const VerifyOptions& measure,
                               TrialAim) { return run(purpose, s, measure); });
  }
};

}  // namespace pdsm
