// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/options.h"
#include "cli/streams.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

int run_check(const std::string& map) {
  const std::vector<FileFault> faults = check_map(read_bytes(map));
  if (!faults.empty()) {
    const FileFault& first = faults.front();
    throw Error(Failure::input, fmt::format("{}:offset {}", map, first.offset),
                fmt::format("fault {}: expected {}", first.number, first.expected));
  }
  write_result("ok\n");
  return kExitOk;
}

}  // namespace

void add_check_command(CommandLine& line) {
  auto map = std::make_shared<std::string>();
  Options takes = line.add_command("check", "Validate a map fully; names the first fault",
                                   [map] { return run_check(*map); });
  takes.file("FILE", *map, "Map");
}

}  // namespace pdsm
