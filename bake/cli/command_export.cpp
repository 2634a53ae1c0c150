// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/options.h"
#include "pdsm/format/deep_exr.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

struct ExportOptions {
  std::string input, output;
};

int run_export(const ExportOptions& options) {
  check_output(options.output, {options.input});
  export_deep_exr(read_map(options.input), options.output);
  return kExitOk;
}

}  // namespace

void add_export_command(CommandLine& line) {
  auto options = std::make_shared<ExportOptions>();
  Options takes = line.add_command("export", "A map to an OpenEXR deep image (Nuke, Natron, oiiotool)",
                                   [options] { return run_export(*options); });
  takes.file("FILE", options->input, "Map");
  takes.text("-o,--output", "FILE", options->output, "Deep image to write").required();
}

}  // namespace pdsm
