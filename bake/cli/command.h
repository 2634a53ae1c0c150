// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/command_line.h"

/// The commands of pdsm. Each add_ function puts one on the command line; docs/commands.md describes them
/// all.
namespace pdsm {

/// Exit codes besides those of Failure (pdsm/format/error.h).
enum ExitCode : int {
  kExitOk = 0,
  kExitDoesNotHold = 1  ///< the check that was asked for did not hold
};

void add_bake_command(CommandLine& line);
void add_merge_command(CommandLine& line);
void add_info_command(CommandLine& line);
void add_check_command(CommandLine& line);
void add_query_command(CommandLine& line);
void add_truth_command(CommandLine& line);
void add_verify_command(CommandLine& line);
void add_tradeoff_command(CommandLine& line);
void add_render_command(CommandLine& line);
void add_export_command(CommandLine& line);
void add_import_command(CommandLine& line);
void add_diff_command(CommandLine& line);

}  // namespace pdsm
