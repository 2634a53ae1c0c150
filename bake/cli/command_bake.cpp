// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "cli/bake_options.h"
#include "cli/bake_record.h"
#include "cli/command.h"
#include "cli/goal_bake.h"
#include "cli/inputs.h"
#include "cli/interrupt.h"
#include "cli/progress_line.h"
#include "cli/shard_bake.h"
#include "cli/streams.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

class StopWatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// One map to make.
struct Job {
  const Light* light;
  BakeOptions options;
  fs::path output;
};

/// Makes the folder for several maps, in a folder that is there.
void make_output_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  if (fs::exists(folder, error)) {
    throw Error(Failure::usage, "--output", "must be a folder, as the scene has several lights");
  }
  if (!fs::create_directory(folder, error)) throw Error(Failure::resource, folder.string(), error.message());
}

std::vector<Job> plan_jobs(const BakeCommand& command, const Scene& scene) {
  const std::vector<const Light*> lights = chosen_lights(scene, command.light);
  std::error_code ignored;
  const bool in_folder = lights.size() > 1 || fs::is_directory(command.output, ignored);
  std::vector<Job> jobs;
  for (const Light* light : lights) {
    fs::path output = command.output;
    if (in_folder) output /= light->name + ".pdsm";
    jobs.push_back({light, options_for(command, *light), output});
  }
  return jobs;
}

void check_outputs(const BakeCommand& command, const std::vector<Job>& jobs) {
  if (jobs.size() > 1) make_output_folder(command.output);
  const std::vector<fs::path> inputs = scene_inputs(command.scene);
  for (const Job& job : jobs) {
    check_output(job.output, inputs);
    if (!command.report.empty() && same_path(job.output, command.report)) {
      throw Error(Failure::usage, "--report", "is the map to write");
    }
  }
  if (!command.report.empty()) check_output(command.report, inputs);
}

void tell_notes(const BakeCommand& command, const Job& job, const BakedMap& baked) {
  if (command.quiet) return;
  constexpr double kWorthTelling = 0.0005;
  for (const std::string& warning : baked.report.warnings) write_warning(job.light->name + ": " + warning);
  if (baked.fitted.receivers_outside >= kWorthTelling) {
    write_error_line(fmt::format("{}: {:.1f}% of the receiver surface lies outside the window",
                                 job.light->name, 100 * baked.fitted.receivers_outside));
  }
}

/// The last look before a map of limited size is written.
void check_size(const Goals& goals, const BakedMap& baked) {
  const std::uint64_t bytes = encoded_map_bytes(baked.map, baked.blocks);
  if (!goals.size_budget || bytes <= *goals.size_budget) return;
  throw GoalMissed(fmt::format("--size-budget: metadata makes the file {} bytes", bytes));
}

BakedMap bake_polled(const BakeCommand& command, const Scene& scene, const Job& job, Checkpoint* checkpoint) {
  ProgressLine line(job.light->name, command.quiet);
  const PolledInterrupts interrupts;
  BakeCallbacks callbacks;
  callbacks.progress = [&line](const BakeProgress& progress) { line.show(progress); };
  callbacks.cancelled = [] { return PolledInterrupts::interrupted(); };
  BakedMap baked = bake(scene, *job.light, job.options, callbacks, checkpoint);
  if (PolledInterrupts::interrupted()) throw Error(Failure::interrupted, "", "interrupted");
  return baked;
}

/// Writes one map; its report. `chosen` is null unless the bake had goals.
nlohmann::ordered_json write_job(const BakeCommand& command, const Scene& scene, const Job& job,
                                 BakedMap& baked, const ChosenBake* chosen, double seconds_load) {
  baked.map.metadata = bake_metadata(scene, *job.light, job.options, baked, chosen);
  if (chosen != nullptr) check_size(command.goals, baked);
  const StopWatch watch;
  BakeCosts costs;
  costs.file_bytes = write_encoded_map(baked.map, baked.blocks, job.output);
  costs.seconds_load = seconds_load;
  costs.seconds_write = watch.seconds();
  tell_notes(command, job, baked);
  return bake_report(job.options, baked, costs, chosen);
}

/// Bakes and writes one map; its report.
nlohmann::ordered_json bake_job(const BakeCommand& command, const Scene& scene, const Job& job,
                                double seconds_load) {
  const std::unique_ptr<Checkpoint> checkpoint =
      make_checkpoint(command.checkpoint, job.output, command.quiet);
  BakedMap baked = bake_polled(command, scene, job, checkpoint.get());
  nlohmann::ordered_json report = write_job(command, scene, job, baked, nullptr, seconds_load);
  if (checkpoint) checkpoint->remove();
  return report;
}

/// The same to goals, in `time_budget` seconds when the command has such a goal.
nlohmann::ordered_json bake_job_to_goals(const BakeCommand& command, const Scene& scene, const Job& job,
                                         std::optional<double> time_budget, double seconds_load) {
  ChosenBake chosen = bake_to_goals(command, scene, *job.light, job.options, time_budget);
  if (!command.quiet) write_error_line(job.light->name + ": " + chosen_text(chosen));
  const Job as_chosen{job.light, chosen.options, job.output};
  return write_job(command, scene, as_chosen, chosen.baked, &chosen, seconds_load);
}

/// Bakes all maps to goals; a time budget is for all of them together.
nlohmann::ordered_json bake_all_to_goals(const BakeCommand& command, const Scene& scene,
                                         const std::vector<Job>& jobs, double seconds_load) {
  const StopWatch watch;
  nlohmann::ordered_json reports;
  for (std::size_t n = 0; n < jobs.size(); ++n) {
    std::optional<double> share;
    if (command.goals.time_budget) {
      share = (*command.goals.time_budget - watch.seconds()) / static_cast<double>(jobs.size() - n);
    }
    reports[jobs[n].light->name] = bake_job_to_goals(command, scene, jobs[n], share, seconds_load);
  }
  if (command.goals.time_budget && watch.seconds() > *command.goals.time_budget) {
    write_warning(fmt::format("--time-budget: took {:.1f} s", watch.seconds()));
  }
  return reports;
}

void print_prediction(const Scene& scene, const Job& job) {
  const BakePrediction prediction = predict_bake(scene, *job.light, job.options);
  const FittedView fitted = fit_view(scene, *job.light, job.options.width, job.options.height);
  const auto& window = fitted.view.window;
  write_result(fmt::format(
      "{}\n"
      "  rays               {}\n"
      "  events             {}\n"
      "  time               about {}\n"
      "  memory             {:.0f} MB, {:.0f} MB of them scene and BVH\n"
      "  tiles              {} of {} x {} texels\n"
      "  window             [{:.6g}, {:.6g}, {:.6g}, {:.6g}]{}\n"
      "  near, far          {:.6g}, {:.6g} m\n"
      "  receivers outside  {:.2f}%\n",
      job.light->name, prediction.rays, prediction.events, minutes_text(prediction.seconds),
      1e-6 * static_cast<double>(prediction.scene_bytes + prediction.memory_bytes),
      1e-6 * static_cast<double>(prediction.scene_bytes), prediction.tiles, prediction.tile, prediction.tile,
      window[0], window[1], window[2], window[3], fitted.window_fitted ? ", fitted" : "",
      fitted.view.near_depth, fitted.view.far_depth, 100 * fitted.receivers_outside));
}

void bake_jobs(const BakeCommand& command, const Scene& scene, const std::vector<Job>& jobs,
               double seconds_load) {
  check_outputs(command, jobs);
  nlohmann::ordered_json reports;
  if (command.goals.any()) {
    reports = bake_all_to_goals(command, scene, jobs, seconds_load);
  } else {
    for (const Job& job : jobs) reports[job.light->name] = bake_job(command, scene, job, seconds_load);
  }
  if (command.report.empty()) return;
  write_report(command.report, jobs.size() == 1 ? reports.front() : reports);
}

int run_bake(const BakeCommand& command) {
  if (command.output.empty() && !command.dry_run) {
    throw Error(Failure::usage, "--output", "is required, except for --dry-run");
  }
  check_goals(command);
  if (command.shard) check_shard(command);
  const StopWatch watch;
  const Scene scene = read_scene(command.scene);
  const double seconds_load = watch.seconds();
  if (!command.quiet) {
    for (const std::string& warning : scene.warnings) write_warning(warning);
  }
  if (command.shard) {
    run_shard_bake(command, scene);
    return kExitOk;
  }
  const std::vector<Job> jobs = plan_jobs(command, scene);
  if (command.dry_run) {
    for (const Job& job : jobs) print_prediction(scene, job);
    return kExitOk;
  }
  try {
    bake_jobs(command, scene, jobs, seconds_load);
  } catch (const GoalMissed& missed) {
    write_error_line(missed.what());
    return kExitDoesNotHold;
  }
  return kExitOk;
}

}  // namespace

void add_bake_command(CLI::App& app, Run& run) {
  auto command = std::make_shared<BakeCommand>();
  CLI::App& sub = *app.add_subcommand("bake", "Bake the maps of a scene's lights");
  add_bake_options(sub, *command);
  sub.callback([command, &run] { run = [command] { return run_bake(*command); }; });
}

}  // namespace pdsm
