// SPDX-License-Identifier: Apache-2.0
#include "cli/checkpoint_choice.h"

#include "cli/options.h"
#include "cli/streams.h"

namespace pdsm {

void add_checkpoint_options(Options& takes, CheckpointChoice& choice) {
  constexpr double kMostSeconds = 1e6;
  const Option interval =
      takes.real("--checkpoint", choice.interval, 0, kMostSeconds,
                 "Seconds between saves of what is done to OUTPUT.partial, with which the next "
                 "such bake goes on; default 10");
  takes.flag("--no-checkpoint", choice.none, "Neither read nor write OUTPUT.partial").excludes(interval);
}

std::unique_ptr<Checkpoint> make_checkpoint(const CheckpointChoice& choice,
                                            const std::filesystem::path& output, bool quiet) {
  if (choice.none) return nullptr;
  CheckpointSettings settings;
  settings.file = output;
  settings.file += ".partial";
  settings.interval = choice.interval;
  if (!quiet) settings.notice = [](const std::string& line) { write_warning(line); };
  return std::make_unique<Checkpoint>(std::move(settings));
}

}  // namespace pdsm
