// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "part/shard_file.h"
#include "pdsm/bake/bake.h"

namespace pdsm {

/// A shard and what to call it.
struct NamedShard {
  std::string name;
  const ShardContents* contents;
};

/// As merge_shards() of files, with limits for blocks of any origin.
[[nodiscard]] BakedMap merge_contents(std::span<const NamedShard> shards, std::uint32_t threads,
                                      const ReadLimits& limits = {});

}  // namespace pdsm
