// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/measure.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "evaluate/map_statistics.h"
#include "pdsm/bake/view_fit.h"
#include "tradeoff/processor_time.h"
#include "truth/random.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A map with the ends of domain that the centre's has: they do not depend on samples, so one will do.
PenumbraMap bake_domain(const MeasureInput& input) {
  BakeOptions options = options_of(input.centre, input.options);
  options.samples = 1;
  return decode_blocks(bake(input.scene, input.light, options));
}

/// The same points under another light.
ProbedTruth trace_again(ProbedTruth truth, const Scene& scene, const Light& light, double near_depth,
                        const VerifyOptions& options) {
  enum Stream : std::uint64_t { kA = 0x100, kB };  // apart from those of probe_truth()
  const ShadowRays rays(scene, light, near_depth);
  const std::uint32_t half = std::max(1U, options.samples / 2);
  truth.a = rays.rgbs(truth.points, half, hash_bits(options.seed, kA));
  truth.b = rays.rgbs(truth.points, half, hash_bits(options.seed, kB));
  return truth;
}

}  // namespace

Measurer::Measurer(MeasureInput input) : input_(std::move(input)) {
  const PenumbraMap map = bake_domain(input_);
  truths_[1] = probe_truth(map, input_.scene, input_.light, input_.verify);
  // A fitted window is that of the light at its own size.
  input_.light.window = map.views.front().window;
}

Light Measurer::light_of(const TradeoffSetting& setting) const {
  return scaled_light(input_.light, setting.light_scale);
}

std::filesystem::path Measurer::file_of(const TradeoffSetting& setting) const {
  return input_.maps / (setting_key(setting) + ".pdsm");
}

const ProbedTruth& Measurer::truth_of(double light_scale) {
  const auto found = truths_.find(light_scale);
  if (found != truths_.end()) return found->second;
  const Light light = scaled_light(input_.light, light_scale);
  const double near_depth =
      fit_view(input_.scene, light, input_.centre.width, input_.centre.height).view.near_depth;
  return truths_[light_scale] = trace_again(truths_[1], input_.scene, light, near_depth, input_.verify);
}

Measurer::Baked Measurer::bake_one(const TradeoffSetting& setting, const BakeCallbacks& callbacks) {
  const Light light = light_of(setting);
  const BakeOptions options = options_of(setting, input_.options);
  Baked result;
  Measurement& m = result.measurement;
  m.setting = setting;
  const double start = now(), cpu_start = processor_seconds();
  result.map = bake(input_.scene, light, options, callbacks);
  result.map.map.metadata = input_.metadata(light, options, result.map);
  m.file_bytes = write_encoded_map(result.map.map, result.map.blocks, file_of(setting));
  m.seconds = now() - start;
  m.cpu_seconds = processor_seconds() - cpu_start;
  m.rays = result.map.report.rays;
  m.events = result.map.report.events;
  m.pieces = result.map.report.pieces;
  m.gpu_bytes = texture_bytes(result.map);
  return result;
}

std::vector<Measurement> Measurer::measure(std::span<const TradeoffSetting> group,
                                           std::span<const TradeoffSetting> keep,
                                           const BakeCallbacks& callbacks) {
  std::vector<BakedMap> maps;
  std::vector<Measurement> measurements;
  for (const TradeoffSetting& setting : group) {
    Baked baked = bake_one(setting, callbacks);
    baked.measurement.error = verify(decode_blocks(baked.map), truth_of(setting.light_scale));
    if (std::find(keep.begin(), keep.end(), setting) == keep.end()) std::filesystem::remove(file_of(setting));
    maps.push_back(std::move(baked.map));
    measurements.push_back(baked.measurement);
  }
  const std::vector<TubeCheck> checks = check_tubes(
      input_.scene, light_of(group.front()), options_of(group.front(), input_.options), maps, callbacks);
  for (std::size_t n = 0; n < checks.size(); ++n) measurements[n].tube = checks[n];
  return measurements;
}

void Measurer::bake_to_keep(const TradeoffSetting& setting, const BakeCallbacks& callbacks) {
  (void)bake_one(setting, callbacks);
}

}  // namespace pdsm
