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

void add_import_command(CommandLine& line) {
  auto options = std::make_shared<ImportOptions>();
  Options takes = line.add_command("import", "A deep image that `pdsm export` wrote back to a map",
                                   [options] { return run_import(*options); });
  takes.file("DEEP", options->input, "Deep image");
  takes.text("-o,--output", "FILE", options->output, "Map to write").required();
}

}  // namespace pdsm
