// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tradeoff/sweep.h"

namespace pdsm {

/// A measurement, and where it stands among the others.
struct Standing {
  std::string name;  ///< "default", a preset's, or empty
  bool on_time_front = false, on_file_front = false, on_gpu_front = false;
};

/// Where each measurement of a sweep stands, in order. Time is processor time. Fronts are of the light at its
/// own size: others light another scene.
[[nodiscard]] std::vector<Standing> find_standings(const Sweep& sweep);

/// One line a measurement, with a heading.
[[nodiscard]] std::string csv_of(const Sweep& sweep, const std::vector<Standing>& standings);

/// The same, and what was measured of what.
[[nodiscard]] nlohmann::ordered_json json_of(const Scene& scene, const Sweep& sweep,
                                             const std::vector<Standing>& standings,
                                             const SweepOptions& options);

/// A setting with a name, and what errs least among those measured for no more seconds and no more bytes of
/// the file; itself where nothing is better.
struct NamedStanding {
  std::string name;
  const Measurement* measured;
  const Measurement* best_in_time;
  const Measurement* best_in_file;
};

/// Of the default and the presets, in the plan's order. Borrows the sweep.
[[nodiscard]] std::vector<NamedStanding> named_standings(const Sweep& sweep);

/// All functions of the sweep together; the margin is of those with epsilon > 0 and those that left the tube.
[[nodiscard]] TubeCheck total_tube(const Sweep& sweep);

}  // namespace pdsm
