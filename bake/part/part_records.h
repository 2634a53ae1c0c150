// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pdsm/format/map_file.h"
#include "pdsm/format/penumbra_map.h"
#include "tile/bake_tile.h"
#include "tile/tile_block.h"

/// What part files are made of, as bytes and back. Reading is safe on any bytes.
namespace pdsm {

/// Whose part, and which.
struct PartHeader {
  std::uint64_t identity = 0;           ///< identity_of() the map's key
  std::uint32_t share = 1, shares = 1;  ///< 1 .. shares
  friend bool operator==(const PartHeader&, const PartHeader&) = default;
};

/// What all blocks of a bake have in common.
struct PartShape {
  VertexCoding coding;
  std::uint32_t width = 0, height = 0;  ///< texels of level 0
  std::uint32_t mip_levels = 0;         ///< above 0
  bool has_domain_ends = false;
  std::uint32_t first_block = 0;  ///< of the view, counted through all views of the map
};

struct PartRecord {
  std::uint32_t type = 0;  ///< part_layout.h
  std::span<const std::byte> payload;
};

/// What a part file holds up to the first byte that is not as it should be.
struct PartScan {
  PartHeader header;
  std::vector<PartRecord> records;
  std::uint64_t good_bytes = 0;  ///< header and records
};

/// The first half of a map's key (pdsm/bake/map_key.h): 16 hexadecimal digits of 32.
[[nodiscard]] std::uint64_t identity_of(const std::string& key);

void append_part_header(const PartHeader& header, std::vector<std::byte>& bytes);
void append_record(std::uint32_t type, std::span<const std::byte> payload, std::vector<std::byte>& bytes);

/// A BLCK record; `base` is level 0 of `block`, encoded. `first_block`: as PartShape has it.
void append_block(const VertexCoding& coding, const FittedBlock& block, const EncodedBlock& base,
                  std::uint32_t first_block, std::vector<std::byte>& bytes);
/// A TILE record.
void append_tile(const TileStatistics& tile, std::vector<std::byte>& bytes);

/// Whether a file that begins so is a part file, or the torn beginning of one.
[[nodiscard]] bool begins_as_part(std::span<const std::byte> bytes);

/// Nothing where the header is torn, damaged or of another version. Payloads point into `bytes`.
[[nodiscard]] std::optional<PartScan> scan_part(std::span<const std::byte> bytes);

/// The block of a BLCK record; nothing where that is no block of such a map, or one whose functions would
/// take more memory than `limits` allow.
[[nodiscard]] std::optional<FittedBlock> read_block(const PartShape& shape,
                                                    std::span<const std::byte> payload,
                                                    const ReadLimits& limits = {});
/// Counts what can be counted from the functions of a block: pieces and empty texels.
void count_functions(FittedBlock& block);
/// The statistics of a TILE record; nothing where it has another size or numbers that none can have.
[[nodiscard]] std::optional<TileStatistics> read_tile(std::span<const std::byte> payload);

}  // namespace pdsm
