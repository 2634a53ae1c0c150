// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

namespace pdsm {

/// Compares what shards say of their bakes, so that the first difference from the first shard can be named:
/// throws Error (input) "b.shard:options: ...". Says nothing where nothing can be named.
void check_descriptions(std::span<const std::filesystem::path> shards);

}  // namespace pdsm
