// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "pdsm/bake/bake.h"

/// One bake on several machines: each bakes a share of the map into a shard file (docs/part-files.md), and
/// merging those gives the same bytes as one machine's bake.
namespace pdsm {

/// The `index`-th of `count` shares of a map's blocks.
struct Share {
  std::uint32_t index = 1, count = 1;  ///< 1 .. count, 1 .. kMostShares
};
inline constexpr std::uint32_t kMostShares = 65536;

/// One JSON object that a shard carries for its caller and that becomes the map's metadata, told from the
/// bake as it is known before the first block: counts are 0, and blocks are none. Must come out the same for
/// all shards of a bake.
using DescribeBake = std::function<std::string(const BakedMap& baked)>;

/// Bakes one share of what bake() would bake, and writes it to `path` whole or not at all. Who gets which
/// blocks depends on the map's size alone. Returns the size of the file. Throws as bake() does, and Error
/// (usage) where the map has fewer blocks of 64 x 64 texels than there are shares, (resource) where `path`
/// can't be written.
std::uint64_t bake_shard(const Scene& scene, const Light& light, const BakeOptions& options,
                         const Share& share, const DescribeBake& describe, const std::filesystem::path& path,
                         const BakeCallbacks& callbacks = {}, Checkpoint* checkpoint = nullptr);

/// The description in a shard file. Throws Error (input) where the file is no shard, unfinished or damaged.
/// Safe on any bytes.
[[nodiscard]] std::string read_shard_description(const std::filesystem::path& path);

/// Joins all shards of a bake, in any order; the description becomes the map's metadata. In the report,
/// seconds are sums over the shards, and memory is that of the largest. `threads`: 0 for all processors.
/// Throws Error (input) "path: reason" where a file is no whole shard, belongs to another bake, or is there
/// twice, and "shards: reason" where some are missing. Safe on any bytes.
[[nodiscard]] BakedMap merge_shards(std::span<const std::filesystem::path> paths, std::uint32_t threads = 0);

}  // namespace pdsm
