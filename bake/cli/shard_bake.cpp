// SPDX-License-Identifier: Apache-2.0
#include "cli/shard_bake.h"

#include <filesystem>

#include "cli/bake_record.h"
#include "cli/inputs.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/progress_line.h"
#include "pdsm/bake/shard.h"
#include "pdsm/format/error.h"

namespace pdsm {

Share parse_share(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) refuse_value("--shard", "I/N, e.g. 2/4", text);
  Share share;
  share.count = static_cast<std::uint32_t>(parse_count("--shard", text.substr(slash + 1), 1, kMostShares));
  share.index = static_cast<std::uint32_t>(parse_count("--shard", text.substr(0, slash), 1, share.count));
  return share;
}

void check_shard(const BakeCommand& command) {
  if (command.goals.any()) {
    throw Error(Failure::usage, "--shard",
                "can't go with a goal, which takes whole bakes: give the settings");
  }
  if (command.dry_run) throw Error(Failure::usage, "--shard", "can't go with --dry-run");
  if (!command.report.empty()) {
    throw Error(Failure::usage, "--report", "is of all shards: give it to merge");
  }
}

void run_shard_bake(const BakeCommand& command, const Scene& scene) {
  const Light& light = choose_light(scene, command.light);
  check_output(command.output, scene_inputs(command.scene));
  BakeOptions options = options_for(command, light);
  options.block_keys = true;
  const std::unique_ptr<Checkpoint> checkpoint =
      make_checkpoint(command.checkpoint, command.output, command.quiet);
  {
    ProgressLine line(
        {light.name, std::to_string(command.shard->index) + "/" + std::to_string(command.shard->count)},
        progress_style(command));
    const PolledInterrupts interrupts;
    BakeCallbacks callbacks;
    callbacks.progress = [&line](const BakeProgress& progress) { line.show(progress); };
    callbacks.cancelled = [] { return PolledInterrupts::interrupted(); };
    const auto describe = [&](const BakedMap& baked) { return bake_metadata(light, options, baked); };
    bake_shard(scene, light, options, *command.shard, describe, command.output, callbacks, checkpoint.get());
  }
  if (checkpoint) checkpoint->remove();
}

}  // namespace pdsm
