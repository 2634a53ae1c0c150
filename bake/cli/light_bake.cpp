// SPDX-License-Identifier: Apache-2.0
#include "cli/light_bake.h"

#include <fmt/format.h>

#include <memory>
#include <system_error>

#include "cli/bake_record.h"
#include "cli/checkpoint_choice.h"
#include "cli/goal_bake.h"
#include "cli/interrupt.h"
#include "cli/job_key.h"
#include "cli/progress_line.h"
#include "cli/stop_watch.h"
#include "cli/streams.h"
#include "cli/verify_report.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;
using Status = LightOutcome::Status;

void tell_outside(const BakeCommand& command, const Light& light, const FittedView& fitted) {
  constexpr double kWorthTelling = 0.0005;
  if (command.quiet || fitted.receivers_outside < kWorthTelling) return;
  write_error_line(fmt::format("{}: {:.1f}% of the receiver surface lies outside the window", light.name,
                               100 * fitted.receivers_outside));
}

/// The last look before a map of limited size is written.
void check_size(const Goals& goals, const BakedMap& baked) {
  const std::uint64_t bytes = encoded_map_bytes(baked.map, baked.blocks);
  if (!goals.size_budget || bytes <= *goals.size_budget) return;
  throw GoalMissed(fmt::format("--size-budget: metadata makes the file {} bytes", bytes));
}

BakedMap bake_polled(const LightBakeInput& input, const MapJob& job, Checkpoint* checkpoint) {
  ProgressLine line({job.light->name, ""}, progress_style(input.command));
  const PolledInterrupts interrupts;
  BakeCallbacks callbacks;
  callbacks.progress = [&line](const BakeProgress& progress) { line.show(progress); };
  callbacks.cancelled = [] { return PolledInterrupts::interrupted(); };
  BakeOptions options = job.options;
  options.block_keys = true;
  if (!input.command.force) options.previous = job.output;
  BakedMap baked = bake(input.scene, *job.light, options, callbacks, checkpoint);
  if (PolledInterrupts::interrupted()) throw Error(Failure::interrupted, "", "interrupted");
  return baked;
}

/// Measures a map as `pdsm verify` does.
void measure(const LightBakeInput& input, const MapJob& job, const PenumbraMap& map, LightOutcome& outcome) {
  if (!input.command.verify) return;
  VerifyOptions options;
  options.points = input.command.verify_points;
  options.free_space = job.options.receivers != Receivers::surfaces;
  outcome.error = verify(map, input.scene, *job.light, options);
  outcome.report["error"] = verify_result_json(*outcome.error);
}

/// Writes a map, with what is to be said about it.
void write_baked(const LightBakeInput& input, const MapJob& job, BakedMap& baked, const ChosenBake* chosen,
                 const nlohmann::ordered_json& asked, LightOutcome& outcome) {
  tell_warnings(input.command, job.light->name, baked.report.warnings);
  baked.map.metadata = bake_metadata(*job.light, job.options, baked, chosen, asked);
  if (chosen != nullptr) check_size(input.command.goals, baked);
  const StopWatch watch;
  BakeCosts costs;
  costs.file_bytes = write_encoded_map(baked.map, baked.blocks, job.output);
  costs.seconds_load = input.seconds_load;
  costs.seconds_write = watch.seconds();
  tell_outside(input.command, *job.light, baked.fitted);
  outcome.report = bake_report(job.options, baked, costs, chosen);
  outcome.key = baked.report.key;
  outcome.bytes = costs.file_bytes;
  outcome.rays = baked.report.rays;
  outcome.pieces = baked.report.pieces;
  outcome.blocks = baked.report.blocks;
  outcome.blocks_taken_over = baked.report.blocks_taken_over;
  outcome.view = baked.fitted.view;
  if (input.command.verify) measure(input, job, decode_blocks(baked), outcome);
}

void bake_to_options(const LightBakeInput& input, const MapJob& job, LightOutcome& outcome) {
  const std::unique_ptr<Checkpoint> checkpoint =
      make_checkpoint(input.command.checkpoint, job.output, input.command.quiet);
  BakedMap baked = bake_polled(input, job, checkpoint.get());
  write_baked(input, job, baked, nullptr, nullptr, outcome);
  if (checkpoint) checkpoint->remove();
}

void bake_to_goals(const LightBakeInput& input, const MapJob& job, const JobKey& key,
                   std::optional<double> time_share, LightOutcome& outcome) {
  ChosenBake chosen = bake_to_goals(input.command, input.scene, *job.light, job.options, time_share);
  if (!input.command.quiet) write_error_line(job.light->name + ": " + chosen_text(chosen));
  write_baked(input, {job.light, chosen.options, job.output}, chosen.baked, &chosen, key.asked, outcome);
}

/// A map of before must not pass for one of this scene; what is no map is left alone.
bool remove_old_map(const fs::path& path) {
  std::error_code ignored;
  return read_metadata(path) && fs::remove(path, ignored);
}

void skip(const LightBakeInput& input, const MapJob& job, LightOutcome& outcome) {
  outcome.status = Status::skipped;
  outcome.reason = "no receiver that faces the light lies in its window";
  outcome.report["reason"] = outcome.reason;
  const bool removed = remove_old_map(job.output);
  if (input.command.quiet) return;
  write_error_line(job.light->name + ": skipped: " + outcome.reason +
                   (removed ? "; the map of before is removed" : ""));
}

void keep(const LightBakeInput& input, const MapJob& job, const MapKey& key, LightOutcome& outcome) {
  if (const auto checkpoint = make_checkpoint(input.command.checkpoint, job.output, input.command.quiet))
    checkpoint->discard(outcome.key);
  tell_warnings(input.command, job.light->name, key.warnings);
  outcome.status = Status::unchanged;
  const bool has_goals = input.command.goals.any();
  PenumbraMap map;
  if (has_goals || input.command.verify) map = read_map(job.output);
  // Goals chose the resolution.
  outcome.view = has_goals ? map.views.front() : key.fitted.view;
  outcome.bytes = fs::file_size(job.output);
  outcome.report["bytes"]["file"] = outcome.bytes;
  if (!input.command.quiet) write_error_line(job.light->name + ": unchanged");
  tell_outside(input.command, *job.light, key.fitted);
  measure(input, job, map, outcome);
}

/// Whether there is something that the job's key has to be compared with.
bool may_be_up_to_date(const LightBakeInput& input, const MapJob& job) {
  return !input.command.force && read_metadata(job.output);
}

void make_map(const LightBakeInput& input, const MapJob& job, std::optional<double> time_share,
              LightOutcome& outcome) {
  const bool has_goals = input.command.goals.any(), has_map = may_be_up_to_date(input, job);
  // A single map that is not there needs no key beforehand: its bake tells it.
  if (!input.is_level && !has_goals && !has_map) return bake_to_options(input, job, outcome);
  const JobKey key = job_key(input.command, input.scene, job);
  if (input.is_level && key.map.fitted.nothing_receives) return skip(input, job, outcome);
  if (const auto recorded = has_map ? up_to_date_key(key, job.output) : std::nullopt) {
    outcome.key = *recorded;
    return keep(input, job, key.map, outcome);
  }
  if (!has_goals) return bake_to_options(input, job, outcome);
  bake_to_goals(input, job, key, time_share, outcome);
}

}  // namespace

void tell_warnings(const BakeCommand& command, const std::string& where,
                   const std::vector<std::string>& warnings) {
  if (command.warnings_as_errors && !warnings.empty())
    throw Error(Failure::input, where, warnings.front() + " (--warnings-as-errors)");
  if (command.quiet) return;
  for (const std::string& warning : warnings) write_warning(where.empty() ? warning : where + ": " + warning);
}

const char* status_name(Status status) {
  switch (status) {
    case Status::unchanged:
      return "unchanged";
    case Status::skipped:
      return "skipped";
    case Status::failed:
      return "failed";
    case Status::baked:
      break;
  }
  return "baked";
}

LightOutcome bake_light(const LightBakeInput& input, const MapJob& job, std::optional<double> time_share) {
  const StopWatch watch;
  LightOutcome outcome;
  outcome.job = &job;
  outcome.report = nlohmann::ordered_json::object();
  make_map(input, job, time_share, outcome);
  outcome.seconds = watch.seconds();
  outcome.report["status"] = status_name(outcome.status);
  if (!outcome.key.empty()) outcome.report["key"] = outcome.key;
  return outcome;
}

}  // namespace pdsm
