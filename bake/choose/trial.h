// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "choose/settings.h"
#include "evaluate/verify.h"
#include "pdsm/bake/bake.h"
#include "pdsm/bake/scene.h"

namespace pdsm {

/// One bake of a search, and what came of it.
struct Trial {
  std::string purpose;
  Settings settings;
  VerifyResult error;         ///< at this trial's own points
  double standard_error = 0;  ///< of error.mean_abs_error: other points would give another
  double sampling_error = 0;  ///< what exact rays to the map's light samples err by at the same points, by
                              ///< the same number; 0 unless asked for
  std::vector<double> looked_up;   ///< attenuations at these points
  std::uint64_t bytes = 0;         ///< of the file without metadata
  std::uint64_t sample_bytes = 0;  ///< of them, what the light samples take: they grow by themselves
  double seconds_bake = 0, seconds_measure = 0;

  [[nodiscard]] double mean_abs_error() const { return error.mean_abs_error; }
  [[nodiscard]] double seconds() const { return seconds_bake + seconds_measure; }
};

/// What a trial is for.
enum class TrialAim {
  laws,      ///< to learn what settings do
  sampling,  ///< the same, and Trial::sampling_error
  result     ///< its map may be kept: it gets all that a map has
};

struct TrialBake {
  Trial trial;
  BakedMap baked;
};

struct TrialCallbacks {
  std::function<void(const std::string&)> begin;  ///< told what begins now; may be empty
  BakeCallbacks bake;
};

/// Bakes and measures one light with different settings.
class TrialBench {
 public:
  /// Borrows `scene` and `light`. Trials take everything but the settings from `options`.
  TrialBench(const Scene& scene, const Light& light, BakeOptions options, TrialCallbacks callbacks);

  /// Throws as bake() does.
  [[nodiscard]] TrialBake run(const std::string& purpose, const Settings& settings,
                              const VerifyOptions& measure, TrialAim aim) const;

 private:
  void measure(const BakedMap& baked, const VerifyOptions& options, bool with_sampling, Trial& trial) const;

  const Scene& scene_;
  const Light& light_;
  BakeOptions options_;
  TrialCallbacks callbacks_;
};

/// Mean change of the look-ups between two trials at the same points, by the number of points in shadow.
[[nodiscard]] double mean_change(const Trial& a, const Trial& b);

/// Standard error of the mean abs error: of a sum over points drawn at random, divided by how many of them
/// are in shadow.
[[nodiscard]] double standard_error(const VerifyResult& result);

}  // namespace pdsm
