// SPDX-License-Identifier: Apache-2.0
#include "cli/goal_bake.h"

#include <fmt/format.h>

#include <optional>

#include "cli/interrupt.h"
#include "cli/progress_line.h"
#include "pdsm/format/error.h"
#include "scene/scene_channels.h"

namespace pdsm {
namespace {

std::string first_option(const Goals& goals) {
  return goals.target_error ? "--target-error" : goals.time_budget ? "--time-budget" : "--size-budget";
}

}  // namespace

ChosenBake bake_to_goals(const BakeCommand& command, const Scene& scene, const Light& light,
                         const BakeOptions& options, std::optional<double> time_budget) {
  const std::string option = first_option(command.goals);
  if (view_count(light) > 1)
    throw Error(Failure::usage, option, "goals are not for lights of several faces: " + light.name);
  if (may_be_coloured(scene, light))
    throw Error(Failure::usage, option, "goals are not for coloured shadows: " + light.name);
  std::optional<ProgressLine> line;
  const PolledInterrupts interrupts;
  TrialCallbacks callbacks;
  // Each trial has a line of its own, so that its time left is its own too.
  callbacks.begin = [&](const std::string& what) {
    line.emplace(ProgressTitle{light.name, what}, progress_style(command));
  };
  callbacks.bake.progress = [&](const BakeProgress& progress) { line->show(progress); };
  callbacks.bake.cancelled = [] { return PolledInterrupts::interrupted(); };
  Goals goals = command.goals;
  goals.time_budget = time_budget;
  return choose_bake(scene, light, options, fixed_options(command), goals, callbacks);
}

std::string chosen_text(const ChosenBake& chosen) {
  const Trial& trial = chosen.chosen;
  double seconds = 0;
  for (const Trial& each : chosen.trials) seconds += each.seconds();
  return fmt::format("{}: error {:.5f} +- {:.5f} at {} new points, {:.3f} MB; {} bakes in {:.1f} s",
                     settings_text(trial.settings), trial.mean_abs_error(), trial.standard_error,
                     trial.error.points, 1e-6 * static_cast<double>(trial.bytes), chosen.trials.size(),
                     seconds);
}

}  // namespace pdsm
