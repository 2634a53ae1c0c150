// SPDX-License-Identifier: Apache-2.0
#include "choose/trial.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "pdsm/runtime/look_up.h"
#include "truth/shadow_rays.h"

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

/// What the map's light samples err by on their own: exact rays, no texels.
double sampling_error(const PenumbraMap& map, const Scene& scene, const Light& light,
                      const ProbedTruth& truth) {
  std::vector<LightPoint> light_points;
  for (const LightSample& s : map.samples)
    light_points.push_back({glm::dvec3(s.position[0], s.position[1], s.position[2])});
  const ShadowRays rays(scene, light, map.views.front().near_depth);
  double sum = 0;
  for (std::size_t n = 0; n < truth.points.size(); ++n)
    sum += std::abs(rays.attenuation(truth.points[n], light_points) - truth.value(n));
  return sum / static_cast<double>(std::max<std::size_t>(1, truth.shadowed_points()));
}

}  // namespace

TrialBench::TrialBench(const Scene& scene, const Light& light, BakeOptions options, TrialCallbacks callbacks)
    : scene_(scene), light_(light), options_(std::move(options)), callbacks_(std::move(callbacks)) {}

TrialBake TrialBench::run(const std::string& purpose, const Settings& settings, const VerifyOptions& options,
                          TrialAim aim) const {
  if (callbacks_.begin) callbacks_.begin(purpose + ": " + settings_text(settings));
  StopWatch watch;
  TrialBake result;
  Trial& trial = result.trial;
  trial.purpose = purpose;
  trial.settings = settings;
  BakeOptions to_bake = with_settings(options_, settings);
  to_bake.block_keys = aim == TrialAim::result;
  result.baked = bake(scene_, light_, to_bake, callbacks_.bake);
  count_bytes(result.baked, trial);
  trial.seconds_bake = watch.lap();

  if (callbacks_.bake.progress) callbacks_.bake.progress({"measure", 1, 0});
  measure(result.baked, options, aim == TrialAim::sampling, trial);
  trial.seconds_measure = watch.lap();
  if (callbacks_.bake.cancelled && callbacks_.bake.cancelled()) {
    throw Error(Failure::interrupted, "bake", "interrupted");
  }
  return result;
}

void TrialBench::measure(const BakedMap& baked, const VerifyOptions& options, bool with_sampling,
                         Trial& trial) const {
  const PenumbraMap map = decode_blocks(baked);
  const ProbedTruth truth = probe_truth(map, scene_, light_, options);
  trial.error = verify(map, truth);
  trial.standard_error = standard_error(trial.error);
  if (with_sampling) trial.sampling_error = sampling_error(map, scene_, light_, truth);
  const PenumbraLookUp look_up(map);
  for (const glm::dvec3& p : truth.points)
    trial.looked_up.push_back(static_cast<double>(look_up.at({p.x, p.y, p.z}, Filter::bilinear).attenuation));
}

double mean_change(const Trial& a, const Trial& b) {
  assert(a.looked_up.size() == b.looked_up.size());
  double sum = 0;
  for (std::size_t n = 0; n < a.looked_up.size(); ++n) sum += std::abs(a.looked_up[n] - b.looked_up[n]);
  return sum / static_cast<double>(std::max<std::uint64_t>(1, a.error.shadowed_points));
}

double standard_error(const VerifyResult& result) {
  if (result.shadowed_points == 0) return 0;
  const double mean = result.mean_abs_error;
  const double variance = std::max(0.0, result.rms_error * result.rms_error - mean * mean);
  return std::sqrt(variance / static_cast<double>(result.shadowed_points));
}

}  // namespace pdsm
