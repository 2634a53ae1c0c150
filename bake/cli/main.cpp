// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "cli/command.h"
#include "cli/guarded_main.h"
#include "cli/streams.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

void add_commands(CLI::App& app, Run& run) {
  app.set_version_flag("--version", "pdsm " PDSM_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 ok, 1 the check asked for did not hold, 2 usage, 3 bad input,\n"
      "4 output or resource, 130 interrupted. `pdsm COMMAND --help` tells more.");
  add_bake_command(app, run);
  add_merge_command(app, run);
  add_info_command(app, run);
  add_check_command(app, run);
  add_query_command(app, run);
  add_truth_command(app, run);
  add_verify_command(app, run);
  add_tradeoff_command(app, run);
  add_render_command(app, run);
  add_export_command(app, run);
  add_import_command(app, run);
  add_diff_command(app, run);
}

/// Parses and runs. Help and version count as results.
int run_command_line(int argc, char** argv) {
  CLI::App app("Bakes soft shadows of area lights into maps that anything can look up anywhere.", "pdsm");
  Run run;
  add_commands(app, run);
  const auto is_wanted = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && app.get_subcommands(is_wanted).empty()) {
    throw Error(Failure::usage, argv[1], "no such command (--help lists them)");
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    write_result(std::string(version.what()) + "\n");
    return kExitOk;
  } catch (const CLI::Success&) {
    write_result(app.help());
    return kExitOk;
  } catch (const CLI::Error& error) {
    throw Error(Failure::usage, "", std::string(error.what()) + " (--help tells more)");
  }
  return run();
}

}  // namespace
}  // namespace pdsm

int main(int argc, char** argv) {
  return pdsm::guarded_main([&] { return pdsm::run_command_line(argc, argv); });
}
