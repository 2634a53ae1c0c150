// SPDX-License-Identifier: Apache-2.0
#include "part/part_records.h"

#include <xxhash.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstring>

#include "bytes.h"
#include "part/part_layout.h"
#include "pdsm/bake/bake.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

std::uint64_t record_checksum(const RecordHeader& header, std::span<const std::byte> payload) {
  const std::uint64_t seed = XXH3_64bits(&header, offsetof(RecordHeader, checksum));
  return XXH3_64bits_withSeed(payload.data(), payload.size(), seed);
}

void append_level(const EncodedBlock& level, std::vector<std::byte>& bytes) {
  append_value(bytes, BlockLevelHeader{level.encoding, 0, level.decoded_bytes, level.bytes.size()});
  append_array<std::byte>(bytes, level.bytes);
}

/// The record at the reader; nothing at the end, and where it is torn or damaged.
std::optional<PartRecord> next_record(std::span<const std::byte> bytes, ByteReader& reader) {
  const auto header = reader.value<RecordHeader>();
  if (!reader.ok() || header.reserved != 0 || header.size > kMostRecordBytes) return {};
  const std::size_t begin = reader.position();
  reader.skip(header.size);
  if (!reader.ok()) return {};
  const PartRecord record{header.type, bytes.subspan(begin, header.size)};
  if (record_checksum(header, record.payload) != header.checksum) return {};
  return record;
}

/// One level of a block.
std::optional<FunctionBlock> read_level(const PartShape& shape, std::uint32_t width, std::uint32_t height,
                                        const ReadLimits& limits, ByteReader& reader) {
  const auto header = reader.value<BlockLevelHeader>();
  if (!reader.ok() || header.reserved != 0 || header.stored_bytes > reader.remaining() ||
      header.decoded_bytes > limits.decoded_bytes)
    return {};
  EncodedBlock encoded{header.encoding, header.decoded_bytes, std::uint64_t{width} * height, 0, {}};
  encoded.bytes.resize(header.stored_bytes);
  reader.array(std::span(encoded.bytes));
  try {
    FunctionBlock block = decode_block(shape.coding, width, height, encoded);
    if (block.domain_end.empty() == shape.has_domain_ends) return {};
    return block;
  } catch (const Error& error) {
    if (error.failure() != Failure::input) throw;
    return {};
  }
}

}  // namespace

std::uint64_t identity_of(const std::string& key) {
  constexpr std::size_t kDigits = 16;
  std::uint64_t identity = 0;
  assert(key.size() >= kDigits);
  std::from_chars(key.data(), key.data() + kDigits, identity, 16);
  return identity;
}

void append_part_header(const PartHeader& header, std::vector<std::byte>& bytes) {
  PartHeaderRecord record;
  record.identity = header.identity;
  record.share = header.share;
  record.shares = header.shares;
  record.checksum = XXH3_64bits(&record, offsetof(PartHeaderRecord, checksum));
  append_value(bytes, record);
}

void append_record(std::uint32_t type, std::span<const std::byte> payload, std::vector<std::byte>& bytes) {
  RecordHeader header{type, 0, payload.size(), 0};
  header.checksum = record_checksum(header, payload);
  append_value(bytes, header);
  append_array(bytes, payload);
}

void append_block(const VertexCoding& coding, const FittedBlock& block, const EncodedBlock& base,
                  std::uint32_t first_block, std::vector<std::byte>& bytes) {
  std::vector<std::byte> payload;
  append_value(payload,
               BlockHeaderRecord{first_block + block.index, static_cast<std::uint32_t>(block.levels.size()),
                                 block.counts.events, block.counts.undarkened_texels, block.inputs});
  append_level(base, payload);
  for (std::uint32_t l = 1; l < block.levels.size(); ++l) {
    const std::uint32_t width = block.width >> l, height = block.height >> l;
    // A narrow block at the border has no texel of the upper levels.
    if (width == 0 || height == 0) continue;
    append_level(encode_block(coding, width, height, block.levels[l], {Compression::none}), payload);
  }
  append_record(kBlockRecord, payload, bytes);
}

void append_tile(const TileStatistics& tile, std::vector<std::byte>& bytes) {
  const TileTotals totals{tile.prepare,        tile.trace,          tile.walk, tile.accumulate, tile.fit,
                          tile.slope_bias_sum, tile.slope_bias_max, tile.rays, tile.event_bytes};
  append_record(kTileRecord, std::as_bytes(std::span(&totals, 1)), bytes);
}

bool begins_as_part(std::span<const std::byte> bytes) {
  const auto magic = std::as_bytes(std::span(kPartMagic)).first(std::min(bytes.size(), kPartMagic.size()));
  return std::equal(magic.begin(), magic.end(), bytes.begin());
}

std::optional<PartScan> scan_part(std::span<const std::byte> bytes) {
  ByteReader reader(bytes);
  const auto header = reader.value<PartHeaderRecord>();
  const bool good = reader.ok() && header.magic == kPartMagic && header.version == kPartVersion &&
                    header.checksum == XXH3_64bits(&header, offsetof(PartHeaderRecord, checksum)) &&
                    header.share >= 1 && header.share <= header.shares;
  if (!good) return {};
  PartScan scan{{header.identity, header.share, header.shares}, {}, sizeof(PartHeaderRecord)};
  while (const auto record = next_record(bytes, reader)) {
    scan.records.push_back(*record);
    scan.good_bytes = reader.position();
  }
  return scan;
}

std::optional<FittedBlock> read_block(const PartShape& shape, std::span<const std::byte> payload,
                                      const ReadLimits& limits) {
  ByteReader reader(payload);
  const auto header = reader.value<BlockHeaderRecord>();
  const std::uint32_t across = (shape.width + kBlockSize - 1) / kBlockSize,
                      up = (shape.height + kBlockSize - 1) / kBlockSize;
  const bool is_of_view = header.index >= shape.first_block && header.index - shape.first_block < across * up;
  if (!reader.ok() || !is_of_view || header.levels != shape.mip_levels + 1) return {};
  FittedBlock block;
  block.index = header.index - shape.first_block;
  const auto extent = block_extent(shape.width, shape.height, block.index % across, block.index / across);
  block.width = extent[0];
  block.height = extent[1];
  block.counts.events = header.events;
  block.counts.undarkened_texels = header.undarkened_texels;
  block.inputs = header.inputs;
  if (block.counts.undarkened_texels > std::uint64_t{block.width} * block.height) return {};
  for (std::uint32_t l = 0; l < header.levels; ++l) {
    FunctionBlock& level = block.levels.emplace_back();
    if (block.width >> l == 0 || block.height >> l == 0) continue;
    auto functions = read_level(shape, block.width >> l, block.height >> l, limits, reader);
    if (!functions) return {};
    level = std::move(*functions);
  }
  if (reader.remaining() != 0) return {};
  count_functions(block);
  return block;
}

void count_functions(FittedBlock& block) {
  const std::vector<std::uint32_t>& first = block.levels.front().first;
  block.counts.pieces = first.back();
  for (std::size_t t = 1; t < first.size(); ++t)
    block.counts.empty_texels += first[t] == first[t - 1] ? 1 : 0;
}

std::optional<TileStatistics> read_tile(std::span<const std::byte> payload) {
  ByteReader reader(payload);
  const auto totals = reader.value<TileTotals>();
  if (!reader.ok() || reader.remaining() != 0) return {};
  for (const double x : {totals.prepare, totals.trace, totals.walk, totals.accumulate, totals.fit,
                         totals.slope_bias_sum, totals.slope_bias_max}) {
    if (!std::isfinite(x) || x < 0) return {};
  }
  TileStatistics tile;
  tile.prepare = totals.prepare;
  tile.trace = totals.trace;
  tile.walk = totals.walk;
  tile.accumulate = totals.accumulate;
  tile.fit = totals.fit;
  tile.slope_bias_sum = totals.slope_bias_sum;
  tile.slope_bias_max = totals.slope_bias_max;
  tile.rays = totals.rays;
  tile.event_bytes = totals.event_bytes;
  return tile;
}

}  // namespace pdsm
