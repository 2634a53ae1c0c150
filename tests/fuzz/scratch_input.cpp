// SPDX-License-Identifier: Apache-2.0
#include "scratch_input.h"

#include <stdlib.h>

#include <fstream>

#include "fuzz_target.h"

namespace pdsm::testing {

namespace fs = std::filesystem;

ScratchInput::ScratchInput() {
  std::string name = (fs::temp_directory_path() / "pdsm-fuzz-XXXXXX").string();
  demand(mkdtemp(name.data()) != nullptr, "a folder for the input can be made");
  folder_ = name;
}

ScratchInput::~ScratchInput() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

fs::path ScratchInput::write(const std::string& name, std::span<const std::uint8_t> bytes) const {
  const fs::path path = folder_ / name;
  // Some file systems flush a file that is overwritten, which would make this slow.
  fs::remove(path);
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  demand(file.good(), "the input can be written");
  return path;
}

}  // namespace pdsm::testing
