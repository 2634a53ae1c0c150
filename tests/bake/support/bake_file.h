// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "pdsm/bake/bake.h"
#include "scratch_folder.h"

namespace pdsm::test {

/// The file that a bake is written to.
inline std::vector<std::byte> file_of(const BakedMap& baked, const std::filesystem::path& path) {
  write_encoded_map(baked.map, baked.blocks, path);
  return pdsm::testing::file_content(path);
}

}  // namespace pdsm::test
