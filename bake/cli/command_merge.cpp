// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/bake_record.h"
#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/light_bake.h"
#include "cli/options.h"
#include "cli/shard_check.h"
#include "cli/stop_watch.h"
#include "cli/streams.h"
#include "pdsm/bake/shard.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

struct MergeCommand {
  std::vector<std::string> shards;
  std::string output, report;
  std::uint32_t threads = 0;
  bool quiet = false;
};

void check_outputs(const MergeCommand& command, const std::vector<fs::path>& shards) {
  check_output(command.output, shards);
  if (command.report.empty()) return;
  if (same_path(command.output, command.report))
    throw Error(Failure::usage, "--report", "is the map to write");
  check_output(command.report, shards);
}

/// As the report of a bake that was done at once.
nlohmann::ordered_json merge_report(const BakeOptions& options, const BakedMap& merged,
                                    const BakeCosts& costs) {
  nlohmann::ordered_json report = bake_report(options, merged, costs);
  report["status"] = status_name(LightOutcome::Status::baked);
  const nlohmann::ordered_json metadata = metadata_of(merged.map);
  if (metadata.contains("key")) report["key"] = metadata["key"];
  return report;
}

int run_merge(const MergeCommand& command) {
  const std::vector<fs::path> shards(command.shards.begin(), command.shards.end());
  check_descriptions(shards);
  check_outputs(command, shards);
  BakedMap merged = merge_shards(shards, command.threads);
  merged.map.metadata = with_modelled(merged.map, merged.report);
  BakeOptions options;
  options.width = merged.map.views.front().width;
  options.height = merged.map.views.front().height;
  BakeCosts costs;
  const StopWatch watch;
  costs.file_bytes = write_encoded_map(merged.map, merged.blocks, command.output);
  costs.seconds_write = watch.seconds();
  if (!command.quiet) {
    for (const std::string& warning : merged.report.warnings) write_warning(warning);
  }
  if (!command.report.empty()) write_report(command.report, merge_report(options, merged, costs));
  return kExitOk;
}

}  // namespace

void add_merge_command(CommandLine& line) {
  auto command = std::make_shared<MergeCommand>();
  Options takes = line.add_command("merge", "Join the shards of a bake to its map",
                                   [command] { return run_merge(*command); });
  takes.texts("SHARD", "FILE", command->shards, "Shards of one bake, all of them, in any order").required();
  takes.text("-o,--output", "FILE", command->output, "Map to write").required();
  takes.text("--report", "FILE.json", command->report, "Write what the shards took, all together");
  takes.count("--threads", command->threads, 0, 1024, "Default 0: all processors");
  takes.flag("--quiet", command->quiet, "Nothing but errors on stderr");
}

}  // namespace pdsm
