// SPDX-License-Identifier: Apache-2.0
#include "choose/trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

class StopWatch {
 public:
  /// Seconds since the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void count_bytes(const BakedMap& baked, Trial& trial) {
  trial.bytes = encoded_map_bytes(baked.map, baked.blocks);
  PenumbraMap without_samples = baked.map;
  without_samples.samples.clear();
  trial.sample_bytes = trial.bytes - encoded_map_bytes(without_samples, baked.blocks);
}

}  // namespace

TrialBench::TrialBench(const Scene& scene, const Light& light, BakeOptions options, TrialCallbacks callbacks)
    : scene_(scene), light_(light), options_(std::move(options)), callbacks_(std::move(callbacks)) {}

TrialBake TrialBench::run(const std::string& purpose, const Settings& settings,
                          const VerifyOptions& measure) const {
  if (callbacks_.begin) callbacks_.begin(purpose + ": " + settings_text(settings));
  StopWatch watch;
  TrialBake result;
  Trial& trial = result.trial;
  trial.purpose = purpose;
  trial.settings = settings;
  result.baked = bake(scene_, light_, with_settings(options_, settings), callbacks_.bake);
  count_bytes(result.baked, trial);
  trial.seconds_bake = watch.lap();

  if (callbacks_.bake.progress) callbacks_.bake.progress({"measure", 1, 0});
  trial.error = verify(decode_blocks(result.baked), scene_, light_, measure);
  trial.standard_error = standard_error(trial.error);
  trial.seconds_measure = watch.lap();
  if (callbacks_.bake.cancelled && callbacks_.bake.cancelled()) {
    throw Error(Failure::interrupted, "bake", "interrupted");
  }
  return result;
}

double standard_error(const VerifyResult& result) {
  if (result.shadowed_points == 0) return 0;
  const double mean = result.mean_abs_error;
  const double variance = std::max(0.0, result.rms_error * result.rms_error - mean * mean);
  return std::sqrt(variance / static_cast<double>(result.shadowed_points));
}

}  // namespace pdsm
