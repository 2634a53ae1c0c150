// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/options.h"
#include "pdsm/format/deep_exr.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

struct ImportOptions {
  std::string input, output;
};

int run_import(const ImportOptions& options) {
  check_output(options.output, {options.input});
  write_map(import_deep_exr(options.input), options.output);
  return kExitOk;
}

}  // namespace

void add_import_command(CLI::App& app, Run& run) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App& command = *app.add_subcommand("import", "A deep image that `pdsm export` wrote back to a map");
  add_file(command, "DEEP", options->input, "Deep image");
  command.add_option("-o,--output", options->output, "Map to write")->required();
  command.callback([options, &run] { run = [options] { return run_import(*options); }; });
}

}  // namespace pdsm
