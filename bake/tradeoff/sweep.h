// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tradeoff/measure.h"
#include "tradeoff/measurement.h"
#include "tradeoff/settings.h"

namespace pdsm {

struct SweepOptions {
  std::filesystem::path folder;  ///< there already; gets journal, maps, tables, plots, pictures and the page
  Effort effort = Effort::normal;
  BakeOptions options;  ///< of the centre: what a bake of the light would have
  VerifyOptions verify;
  std::vector<NamedSetting> presets;
};

/// How far a sweep is.
struct SweepProgress {
  std::string step;  ///< "12/96 256 samples, 512 x 512", "pictures", ...
  double done = 0;   ///< 0..1 of this run's measuring, by cost
};

struct SweepCallbacks {
  std::function<void(const SweepProgress&)> progress;  ///< may be empty
  std::function<bool()> cancelled;                     ///< polled; true ends with Error(interrupted)
  /// The metadata of a map's file.
  std::function<std::string(const Light&, const BakeOptions&, const BakedMap&)> metadata;
};

/// A map that pictures are drawn with.
struct KeptMap {
  std::string name;  ///< "default", "least error", ...
  Measurement measurement;
  std::filesystem::path file;
};

/// What a sweep found.
struct Sweep {
  SweepPlan plan;
  std::vector<Measurement> measurements;  ///< in the plan's order
  std::vector<KeptMap> kept;
  std::size_t earlier = 0;  ///< of the measurements, taken from the journal of an earlier run
  Light light;              ///< at its own size
  double near_depth = 0;    ///< metres, of the light at its own size
  std::size_t points = 0, surface_points = 0;
};

/// Measures all settings that the folder's journal has not, then bakes the maps that pictures need.
/// Throws as bake() does, Error (resource) when the folder can't be written.
[[nodiscard]] Sweep run_sweep(const Scene& scene, const Light& light, const SweepOptions& options,
                              const SweepCallbacks& callbacks);

/// The setting in words: "256 samples, 512 x 512, epsilon 0.02", and what is out of the ordinary.
[[nodiscard]] std::string setting_text(const TradeoffSetting& setting);

/// Throws Error (interrupted) when `callbacks.cancelled` says so.
void stop_if_cancelled(const SweepCallbacks& callbacks);

}  // namespace pdsm
