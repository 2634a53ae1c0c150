// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "faults.h"
#include "file_layout.h"
#include "pdsm/format/map_file.h"

/// The steps of reading a file, for the reader (which stops at the first fault) and the checker (which
/// goes on as far as the parts that hold allow).
namespace pdsm {

/// Header and chunk table, placement and checksums of all chunks. Entries of chunks whose bytes are
/// damaged or unknown are left out of `good`, so that no later step touches them.
struct FileTable {
  std::vector<TableEntry> entries;  ///< in file order
  std::vector<bool> good;           ///< checksum holds, type known
};

/// Empty where header or table are broken, which is added to `faults`.
[[nodiscard]] std::optional<FileTable> parse_table(std::span<const std::byte> bytes, FaultList& faults);

/// Gets block `block` of image `image` of the map.
using BlockSink = std::function<void(std::size_t image, std::size_t block, FunctionBlock&&)>;

/// Parses a whole file. The map comes back without blocks; these go to `sink` one by one. Means anything
/// only while `faults` stays empty.
[[nodiscard]] PenumbraMap parse_map(std::span<const std::byte> bytes, const ReadLimits& limits,
                                    FaultList& faults, const BlockSink& sink);

/// The same up to the blocks, which are not looked into: the map comes back without them.
[[nodiscard]] PenumbraMap parse_frame(std::span<const std::byte> bytes, const ReadLimits& limits,
                                      FaultList& faults);

/// What can be told of a file though some of its blocks are damaged.
struct MapParts {
  PenumbraMap frame;  ///< without blocks, samples and metadata; without block keys where these are damaged
  FileTable table;
  std::vector<std::size_t> blocks;  ///< entries of BLCK chunks: of all images, in their order
};

/// Nothing where header, table, MAPD or the number of blocks don't hold.
[[nodiscard]] std::optional<MapParts> parse_parts(std::span<const std::byte> bytes, const ReadLimits& limits);

}  // namespace pdsm
