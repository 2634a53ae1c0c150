// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "mapped_file.h"
#include "part/facts_record.h"
#include "part/part_layout.h"
#include "part/part_records.h"

namespace pdsm {

/// What a whole shard holds. Payloads point into the bytes that it was read from.
struct ShardContents {
  PartHeader header;
  std::span<const std::byte> facts;  ///< a BAKE record's payload
  std::vector<std::span<const std::byte>> blocks;
  TileStatistics taken;
  EndRecord end;
};

/// Reads the frame of a shard, not its blocks. Throws Error (input) "name: reason" where the bytes are no
/// shard, unfinished or damaged. Safe on any bytes.
[[nodiscard]] ShardContents read_shard(const std::string& name, std::span<const std::byte> bytes);

/// The facts of a shard. Throws likewise.
[[nodiscard]] DescribedFacts read_facts(const std::string& name, const ShardContents& shard);

/// A shard on disk.
struct ShardFile {
  explicit ShardFile(const std::filesystem::path& path)
      : name(path.string()), mapped(path), contents(read_shard(name, mapped.bytes())) {}

  std::string name;
  MappedFile mapped;
  ShardContents contents;
};

}  // namespace pdsm
