// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "pdsm/bake/view_fit.h"
#include "pdsm/format/error.h"
#include "trace/embree_scene.h"
#include "tradeoff/journal.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

/// Everything that measurements depend on besides their settings.
nlohmann::ordered_json identity_of(const Scene& scene, const Light& light, const SweepOptions& options) {
  return {{"version", 1},
          {"input_hash", fmt::format("{:016x}", scene.content_hash)},
          {"light", light.name},
          {"centre", setting_key(setting_of(options.options))},
          {"points", options.verify.points},
          {"truth_samples", options.verify.samples},
          {"seed", options.verify.seed},
          {"isa", choose_isa(options.options.isa)},
          {"threads", options.options.threads},
          {"memory", options.options.memory}};
}

/// The settings whose maps pictures are drawn with: the centre, and for each factor the coarsest beside it.
std::vector<NamedSetting> settings_to_show(const SweepPlan& plan) {
  std::vector<NamedSetting> shown{{"default", plan.centre}};
  const auto show = [&](const char* name, Factor factor, bool least) {
    const TradeoffSetting* coarsest = nullptr;
    for (const SettingGroup& group : plan.groups) {
      for (const TradeoffSetting& s : group.settings) {
        if (s == plan.centre || !same_but_for(factor, plan.centre, s)) continue;
        const auto value = [&](const TradeoffSetting& of) {
          return least ? -factor_value(factor, of) : factor_value(factor, of);
        };
        if (value(s) > value(plan.centre) && (coarsest == nullptr || value(s) > value(*coarsest)))
          coarsest = &s;
      }
    }
    if (coarsest != nullptr) shown.push_back({name, *coarsest});
  };
  show("fewest samples", Factor::samples, true);
  show("coarsest map", Factor::resolution, true);
  show("coarsest sample maps", Factor::map_scale, true);
  show("midpoint walk", Factor::walk, true);
  show("largest epsilon", Factor::epsilon, false);
  return shown;
}

/// One run of a sweep.
class SweepRun {
 public:
  SweepRun(const Scene& scene, const Light& light, const SweepOptions& options,
           const SweepCallbacks& callbacks)
      : scene_(scene), light_(light), options_(options), callbacks_(callbacks) {
    sweep_.plan =
        plan_sweep(setting_of(options.options), options.presets, options.effort, largest_light_scale(light));
    sweep_.light = light;
  }

  Sweep run() {
    fs::create_directories(options_.folder / "maps");
    Journal journal(options_.folder / "journal.jsonl", identity_of(scene_, light_, options_));
    tell("points");
    Measurer measurer({scene_, light_, options_.options, options_.verify, sweep_.plan.centre,
                       options_.folder / "maps", callbacks_.metadata});
    measure_all(measurer, journal);
    keep_maps(measurer);
    describe(measurer);
    return std::move(sweep_);
  }

 private:
  void measure_all(Measurer& measurer, Journal& journal) {
    std::vector<TradeoffSetting> keep;
    for (const NamedSetting& shown : settings_to_show(sweep_.plan)) keep.push_back(shown.setting);
    std::vector<std::vector<TradeoffSetting>> todo;
    for (const SettingGroup& group : sweep_.plan.groups) {
      todo.push_back(missing(journal, group));
      to_do_ += cost_of(todo.back());
    }
    sweep_.earlier = sweep_.plan.setting_count();
    for (const auto& group : todo) sweep_.earlier -= group.size();
    measured_ = sweep_.earlier;
    for (const auto& group : todo) {
      if (group.empty()) continue;
      for (const Measurement& m : measurer.measure(group, keep, bake_callbacks(group))) journal.append(m);
      done_ += cost_of(group);
      measured_ += group.size();
      stop_if_cancelled(callbacks_);
    }
    for (const SettingGroup& group : sweep_.plan.groups) {
      for (const TradeoffSetting& setting : group.settings)
        sweep_.measurements.push_back(*journal.find(setting));
    }
  }

  static std::vector<TradeoffSetting> missing(const Journal& journal, const SettingGroup& group) {
    std::vector<TradeoffSetting> settings;
    for (const TradeoffSetting& setting : group.settings) {
      if (journal.find(setting) == nullptr) settings.push_back(setting);
    }
    return settings;
  }

  /// Of a group's bakes and of the oracle's.
  static double cost_of(const std::vector<TradeoffSetting>& group) {
    if (group.empty()) return 0;
    return (1 + static_cast<double>(group.size())) * setting_cost(group.front());
  }

  /// Callbacks for the bakes of a group, the last of which is the oracle's.
  BakeCallbacks bake_callbacks(const std::vector<TradeoffSetting>& group) {
    BakeCallbacks callbacks;
    callbacks.cancelled = callbacks_.cancelled;
    callbacks.progress = [this, &group, bake = std::size_t{0}, last = 0.0](const BakeProgress& p) mutable {
      if (p.done < last) ++bake;
      last = p.done;
      const std::size_t now = std::min(bake, group.size());
      const TradeoffSetting& setting = group[std::min(now, group.size() - 1)];
      in_group_ = setting_cost(setting) * (static_cast<double>(now) + p.done);
      const std::size_t number = std::min(measured_ + now + 1, sweep_.plan.setting_count());
      tell(fmt::format("{}/{} {}{}", number, sweep_.plan.setting_count(), setting_text(setting),
                       now == group.size() ? ", check" : ""));
    };
    in_group_ = 0;
    return callbacks;
  }

  void tell(const std::string& step) {
    if (callbacks_.progress) callbacks_.progress({step, to_do_ > 0 ? (done_ + in_group_) / to_do_ : 0});
  }

  void keep_maps(Measurer& measurer) {
    in_group_ = 0;
    std::vector<NamedSetting> shown = settings_to_show(sweep_.plan);
    shown.push_back({"least error", least_error().setting});
    for (const NamedSetting& named : shown) {
      const auto is_it = [&](const Measurement& m) { return m.setting == named.setting; };
      const auto found = std::find_if(sweep_.measurements.begin(), sweep_.measurements.end(), is_it);
      const fs::path file = measurer.file_of(named.setting);
      tell("map of " + named.name);
      if (!fs::exists(file)) measurer.bake_to_keep(named.setting, {{}, callbacks_.cancelled});
      stop_if_cancelled(callbacks_);
      sweep_.kept.push_back({named.name, *found, file});
    }
  }

  /// Of the light at its own size.
  const Measurement& least_error() const {
    const Measurement* least = nullptr;
    for (const Measurement& m : sweep_.measurements) {
      if (m.setting.light_scale != 1) continue;
      if (least == nullptr || m.error.mean_abs_error < least->error.mean_abs_error) least = &m;
    }
    return *least;
  }

  void describe(Measurer& measurer) {
    const ProbedTruth& truth = measurer.truth_of(1);
    sweep_.points = truth.points.size();
    sweep_.surface_points = truth.surface_points;
    const TradeoffSetting& centre = sweep_.plan.centre;
    sweep_.near_depth =
        fit_view(scene_, measurer.light_of(centre), centre.width, centre.height).view.near_depth;
  }

  const Scene& scene_;
  const Light& light_;
  const SweepOptions& options_;
  const SweepCallbacks& callbacks_;
  Sweep sweep_;
  std::size_t measured_ = 0;
  double to_do_ = 0, done_ = 0, in_group_ = 0;  ///< cost of this run's measurements
};

}  // namespace

Sweep run_sweep(const Scene& scene, const Light& light, const SweepOptions& options,
                const SweepCallbacks& callbacks) {
  return SweepRun(scene, light, options, callbacks).run();
}

std::string setting_text(const TradeoffSetting& s) {
  std::string text = fmt::format("{} samples, {} x {}, epsilon {}", s.samples, s.width, s.height, s.epsilon);
  if (s.map_scale != 1) text += fmt::format(", sample maps x {}", s.map_scale);
  if (s.walk == Walk::midpoint) text += ", midpoint walk";
  if (s.light_scale != 1) text += fmt::format(", light x {}", s.light_scale);
  return text;
}

void stop_if_cancelled(const SweepCallbacks& callbacks) {
  if (callbacks.cancelled && callbacks.cancelled())
    throw Error(Failure::interrupted, "tradeoff", "interrupted");
}

}  // namespace pdsm
