// SPDX-License-Identifier: Apache-2.0
#include "choose/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "choose/best_bake.h"
#include "choose/laws.h"
#include "choose/measures.h"
#include "choose/shortfall.h"
#include "choose/trial_record.h"
#include "choose/verdict.h"
#include "pdsm/bake/view_fit.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// What the laws see no way for is tried all the same up to so many times the work that was done already.
constexpr double kAffordable = 4;
/// Bakes meant to be the result, at most.
constexpr std::size_t kMostTries = 4;
/// Share of a size budget below which it was not made use of.
constexpr double kSizeUsed = 0.88;
/// Shares of a time budget: of the star, which takes so many times its base; of the trial that tells the
/// speed.
constexpr double kStarShare = 0.2, kStarTimes = 7, kSpeedShare = 0.2;
/// A trial that tells the speed has at least this many times the work of the star's.
constexpr double kTellingWork = 3;
/// Settings that cost less than this share of others are worth another bake.
constexpr double kWorthAnother = 0.85;
/// When memory was too small for some edge, this share of it is tried next.
constexpr double kSmallerEdge = 0.9;

std::uint32_t scaled(std::uint32_t texels, double scale) {
  return static_cast<std::uint32_t>(std::max(1L, std::lround(texels * scale)));
}

class Search {
 public:
  Search(const SearchTask& task, const RunTrial& run)
      : run_(run),
        options_(task.options),
        goals_(task.goals),
        space_{task.fixed, settings_of(task.options), task.aspect} {}

  ChosenBake run() {
    learn();
    while (record_.tries().size() < kMostTries) {
      const std::optional<Settings> settings = choose();
      if (!settings || record_.was_tried(*settings) || !time_allows(*settings)) break;
      if (step_towards(*settings)) continue;
      if (try_settings(*settings)) break;
    }
    std::optional<ChosenBake> best = best_.take();
    if (!best) throw GoalMissed(explain_miss(goals_, record_.tries()));
    best->trials = record_.trials();
    return std::move(*best);
  }

 private:
  Trial small_trial(const std::string& purpose, const Settings& settings, TrialAim aim = TrialAim::laws) {
    record_.note(run_(purpose, settings, trial_measure(options_), aim).trial);
    return record_.trials().back();
  }
  [[nodiscard]] Settings base() const {
    return star_base(goals_, space_.aspect, space_.fixed.map_resolution);
  }

  void learn() {
    const Trial base = small_trial("trial", this->base(), TrialAim::sampling);
    if (goals_.time_budget && kStarTimes * base.seconds() > kStarShare * *goals_.time_budget) {
      laws_.emplace(base);
      return;
    }
    StarTrials star;
    star.base = base;
    star.more_samples = small_trial("trial of samples", with_more_samples(base.settings));
    star.finer = small_trial("trial of texels", with_finer_texels(base.settings));
    star.looser = small_trial("trial of epsilon", with_looser_fit(base.settings));
    if (!space_.fixed.map_resolution)
      star.finer_maps = small_trial("trial of maps", with_finer_maps(base.settings));
    star.fit_change = mean_change(base, star.looser);
    laws_.emplace(star);
  }

  [[nodiscard]] Limits limits() const {
    Limits limits = record_.limits(goals_);
    limits.edge = edge_limit_;
    return limits;
  }

  /// What to bake next. None when the laws see no way any more; throws when they never did.
  std::optional<Settings> choose() {
    const Limits wanted = limits();
    const Wish wish = goals_.target_error ? Wish::least_cost : Wish::least_error;
    if (auto settings = choose_settings(*laws_, space_, wanted, wish)) return settings;
    // The laws may err: where no budget is in the way, what is cheap enough beside the trials is tried all
    // the same.
    const double affordable = kAffordable * record_.largest_work();
    if (!goals_.size_budget && !goals_.time_budget) {
      const auto exact = most_exact_settings(*laws_, space_, wanted);
      if (exact && exact->work() <= affordable) return exact;
    }
    if (!record_.tries().empty()) return std::nullopt;
    throw GoalMissed(explain_shortfall(*laws_, space_, goals_, wanted));
  }

  /// Bakes a trial on the way to settings that lie too far from what was seen. False when none is needed.
  bool step_towards(const Settings& settings) {
    if (goals_.time_budget) return step_for_speed();
    if (settings.edge() <= TrialRecord::kTrustedStep * record_.largest_edge()) return false;
    // Even steps: the last trial before a large bake is as cheap as can be.
    const double ratio = settings.edge() / record_.largest_edge();
    const double steps = std::ceil(std::log(ratio) / std::log(TrialRecord::kTrustedStep));
    const double scale = std::pow(ratio, 1 / steps - 1);
    Settings step = base();
    step.width = scaled(settings.width, scale);
    step.height = scaled(settings.height, scale);
    within_memory(step,
                  [&] { laws_->anchor(small_trial("trial of many texels", step), Laws::Points::same); });
    return true;
  }

  /// Bakes; when memory does not do, smaller maps are chosen from afterwards, and this is false.
  template <typename Bake>
  bool within_memory(const Settings& settings, const Bake& bake) {
    try {
      bake();
      return true;
    } catch (const Error& error) {
      // Trouble with an option, not with the machine.
      const bool by_option = std::string_view(error.what()).starts_with("--");
      if (error.failure() != Failure::resource || !by_option || space_.fixed.resolution) throw;
      edge_limit_ = kSmallerEdge * settings.edge();
      return false;
    }
  }

  /// Bakes what takes a small share of the time budget, once, to learn the speed.
  bool step_for_speed() {
    if (std::exchange(speed_known_, true)) return false;
    Limits wanted = limits();
    wanted.error = std::numeric_limits<double>::infinity();
    wanted.seconds = kSpeedShare * *goals_.time_budget - record_.trials().back().seconds_measure;
    const auto step = choose_settings(*laws_, space_, wanted, Wish::least_error);
    if (!step || step->work() < kTellingWork * record_.largest_work()) return false;
    laws_->anchor(small_trial("trial of speed", *step), Laws::Points::same);
    return true;
  }

  /// Bakes what may be the result, and judges it. True when there is nothing left to do.
  bool try_settings(const Settings& settings) {
    ChosenBake bake;
    bake.goals = goals_;
    bake.options = with_settings(options_, settings);
    bake.measured_by =
        judging_measure(options_, goals_, record_.tries().size(), record_.trials().back(), last_rays_);
    bake.expected_error = laws_->error(settings);
    bake.expected_seconds = laws_->seconds(settings);
    bake.why = describe(settings);
    const bool baked = within_memory(settings, [&] {
      TrialBake result = run_(fmt::format("try {}", record_.tries().size() + 1), settings, bake.measured_by,
                              TrialAim::result);
      bake.baked = std::move(result.baked);
      bake.chosen = std::move(result.trial);
    });
    if (!baked) return false;
    const Trial trial = bake.chosen;
    last_rays_ = bake.measured_by.samples;
    record_.note_try(trial);
    laws_->anchor(trial, Laws::Points::others);
    if (best_.wants(goals_, trial)) best_.keep(std::move(bake));
    return is_enough(trial);
  }

  [[nodiscard]] bool is_enough(const Trial& trial) const {
    if (!fits_size(goals_, trial)) return false;
    if (goals_.target_error)
      return judge(*goals_.target_error, trial) == Verdict::reached || !is_worth_less(trial);
    if (goals_.time_budget) return true;
    return static_cast<double>(trial.bytes + kMetadataBytes) >=
           kSizeUsed * static_cast<double>(*goals_.size_budget);
  }

  /// Whether a try missed its target, or would much cheaper settings do.
  [[nodiscard]] bool is_worth_less(const Trial& trial) const {
    if (judge(*goals_.target_error, trial) == Verdict::too_high) return true;
    const auto cheaper = choose_settings(*laws_, space_, limits(), Wish::least_cost);
    return cheaper && cost_of(*laws_, *cheaper) < kWorthAnother * cost_of(*laws_, trial.settings);
  }

  [[nodiscard]] std::string describe(const Settings& s) const {
    return fmt::format("{}; expected of sampling {:.2g}, resolution {:.2g}, fit {:.2g}",
                       goals_.target_error ? "least time^2 x bytes" : "least error",
                       laws_->sampling_error(s.samples), laws_->resolution_error(s.edge(), s.maps_per_texel),
                       laws_->fit_error(s.epsilon));
  }

  [[nodiscard]] bool time_allows(const Settings& settings) const {
    return !goals_.time_budget || record_.tries().empty() ||
           laws_->seconds(settings) <= record_.seconds_left(*goals_.time_budget);
  }

  const RunTrial& run_;
  BakeOptions options_;
  Goals goals_;
  ChoiceSpace space_;
  std::optional<Laws> laws_;
  TrialRecord record_;
  BestBake best_;
  std::uint32_t last_rays_ = trial_measure({}).samples;          ///< a point, of the last trial
  double edge_limit_ = std::numeric_limits<double>::infinity();  ///< texels, that memory sets
  bool speed_known_ = false;
};

}  // namespace

ChosenBake search(const SearchTask& task, const RunTrial& run) {
  return Search(task, run).run();
}

ChosenBake choose_bake(const Scene& scene, const Light& light, const BakeOptions& options,
                       const FixedOptions& fixed, const Goals& goals, const TrialCallbacks& callbacks) {
  const auto window = fit_view(scene, light, options.width, options.height).view.window;
  const double aspect = (window[2] - window[0]) / (window[3] - window[1]);
  const TrialBench bench(scene, light, options, callbacks);
  return search({options, fixed, goals, aspect},
                [&bench](const auto&... what) { return bench.run(what...); });
}

}  // namespace pdsm
