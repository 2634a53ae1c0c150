// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pdsm/bake/shard.h"
#include "scratch_folder.h"

namespace pdsm::test {

/// A bake in so many shards, merged.
[[nodiscard]] inline BakedMap bake_in_shards(const Scene& scene, const Light& light,
                                             const BakeOptions& options, std::uint32_t count,
                                             const DescribeBake& describe = {}) {
  const pdsm::testing::ScratchFolder folder;
  std::vector<std::filesystem::path> paths;
  for (std::uint32_t index = 1; index <= count; ++index) {
    paths.push_back(folder.path() / std::to_string(index));
    bake_shard(scene, light, options, {index, count}, describe, paths.back());
  }
  return merge_shards(paths);
}

}  // namespace pdsm::test
