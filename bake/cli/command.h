// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

/// The subcommands of pdsm. Each add_ function puts one on `app`; when the command line asks for it, `run`
/// becomes what to do. docs/commands.md describes them all.
namespace pdsm {

/// Exit codes besides those of Failure (pdsm/format/error.h).
enum ExitCode : int {
  kExitOk = 0,
  kExitDoesNotHold = 1  ///< the check that was asked for did not hold
};

/// Does the work of a command. Returns an exit code or throws Error.
using Run = std::function<int()>;

void add_bake_command(CLI::App& app, Run& run);
void add_merge_command(CLI::App& app, Run& run);
void add_info_command(CLI::App& app, Run& run);
void add_check_command(CLI::App& app, Run& run);
void add_query_command(CLI::App& app, Run& run);
void add_truth_command(CLI::App& app, Run& run);
void add_verify_command(CLI::App& app, Run& run);
void add_tradeoff_command(CLI::App& app, Run& run);
void add_render_command(CLI::App& app, Run& run);
void add_export_command(CLI::App& app, Run& run);
void add_import_command(CLI::App& app, Run& run);
void add_diff_command(CLI::App& app, Run& run);

}  // namespace pdsm
