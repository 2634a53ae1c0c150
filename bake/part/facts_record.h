// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tile/bake_facts.h"

/// The BAKE record of a shard: what is known of the bake of each view before its first block.
namespace pdsm {

struct DescribedFacts {
  MapFacts facts;
  std::string description = "{}";  ///< the caller's, one JSON object
};

[[nodiscard]] std::vector<std::byte> encode_facts(const DescribedFacts& described);

/// Inverse; nothing for any other bytes. What is read can make a map: view, coding, samples and levels are
/// checked. Safe on any bytes.
[[nodiscard]] std::optional<DescribedFacts> decode_facts(std::span<const std::byte> payload);

}  // namespace pdsm
