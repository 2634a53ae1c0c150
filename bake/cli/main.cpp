// SPDX-License-Identifier: Apache-2.0
#include "cli/command.h"
#include "cli/guarded_main.h"

namespace pdsm {
namespace {

void add_commands(CommandLine& line) {
  add_bake_command(line);
  add_merge_command(line);
  add_info_command(line);
  add_check_command(line);
  add_query_command(line);
  add_truth_command(line);
  add_verify_command(line);
  add_tradeoff_command(line);
  add_render_command(line);
  add_export_command(line);
  add_import_command(line);
  add_diff_command(line);
}

int run_command_line(int argc, char** argv) {
  CommandLine line("pdsm", "Bakes soft shadows of area lights into maps that anything can look up anywhere.",
                   "pdsm " PDSM_VERSION,
                   "Exit codes: 0 ok, 1 the check asked for did not hold, 2 usage, 3 bad input,\n"
                   "4 output or resource, 130 interrupted. `pdsm COMMAND --help` tells more.");
  add_commands(line);
  return line.parse(argc, argv) ? line.run()() : kExitOk;
}

}  // namespace
}  // namespace pdsm

int main(int argc, char** argv) {
  return pdsm::guarded_main([&] { return pdsm::run_command_line(argc, argv); });
}
