// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <string>

#include "golden_map.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"

/// make_golden FOLDER: writes the golden files of the present version. Run once for each version.
int main(int argument_count, char** arguments) {
  if (argument_count != 2) return 2;
  try {
    const std::string folder = arguments[1];
    pdsm::write_map(pdsm::testing::golden_map(), folder + "/version1-raw.pdsm", {pdsm::Compression::none});
    pdsm::write_map(pdsm::testing::golden_map(), folder + "/version1-zstd.pdsm", {pdsm::Compression::zstd});
    return 0;
  } catch (const pdsm::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.failure());
  }
}
