// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// Part files as they lie on disk (docs/part-files.md): a header, then records.
namespace pdsm {

inline constexpr std::array<unsigned char, 12> kPartMagic{0xAB, 'P',  'D',  'S',  'M',  'p',
                                                          '1',  0xBB, '\r', '\n', 0x1A, '\n'};
inline constexpr std::uint32_t kPartVersion = 2;

/// Bytes that a record may claim; more is no record.
inline constexpr std::uint64_t kMostRecordBytes = std::uint64_t{4} << 30;

struct PartHeaderRecord {
  std::array<unsigned char, 12> magic = kPartMagic;
  std::uint32_t version = kPartVersion;
  std::uint64_t identity = 0;
  std::uint32_t share = 1, shares = 1;
  std::uint64_t checksum = 0;  ///< XXH3 of all before
};
static_assert(sizeof(PartHeaderRecord) == 40 && offsetof(PartHeaderRecord, checksum) == 32);

constexpr std::uint32_t record_type(const char (&name)[5]) {
  std::uint32_t type = 0;
  for (std::size_t n = 0; n < 4; ++n)
    type |= static_cast<std::uint32_t>(static_cast<unsigned char>(name[n])) << (8 * n);
  return type;
}
inline constexpr std::uint32_t kBakeRecord = record_type("BAKE"), kBlockRecord = record_type("BLCK"),
                               kTileRecord = record_type("TILE"), kEndRecord = record_type("DONE");

struct RecordHeader {
  std::uint32_t type = 0, reserved = 0;
  std::uint64_t size = 0;      ///< of the payload behind it
  std::uint64_t checksum = 0;  ///< XXH3 of the payload, seeded with XXH3 of the 16 bytes before
};
static_assert(sizeof(RecordHeader) == 24 && offsetof(RecordHeader, checksum) == 16);

/// Begins the payload of a BLCK record; its levels follow, each a BlockLevelHeader and bytes.
struct BlockHeaderRecord {
  std::uint32_t index = 0, levels = 0;
  std::uint64_t events = 0, undarkened_texels = 0;
  std::array<std::uint64_t, 2> inputs{};  ///< as BlockKey has them; 0, 0 where they were not asked for
};
static_assert(sizeof(BlockHeaderRecord) == 40);

struct BlockLevelHeader {
  std::uint32_t encoding = 0, reserved = 0;
  std::uint64_t decoded_bytes = 0, stored_bytes = 0;
};
static_assert(sizeof(BlockLevelHeader) == 24);

/// The payload of a TILE record.
struct TileTotals {
  double prepare = 0, trace = 0, walk = 0, accumulate = 0, fit = 0;
  double slope_bias_sum = 0, slope_bias_max = 0;
  std::uint64_t rays = 0, event_bytes = 0;
};
static_assert(sizeof(TileTotals) == 72);

/// The payload of a BAKE record begins so; other views', samples, instruction set and the caller's text
/// follow.
struct FactsRecord {
  std::array<double, 9> rotation{};
  std::array<double, 3> translation{};
  std::array<double, 4> window{};
  double near_depth = 0, far_depth = 0, receivers_outside = 0;
  double epsilon = 0, depth_tolerance = 0, bias = 0, slope_limit_from = 0;
  std::uint64_t dropped_triangles = 0;
  std::uint32_t projection = 0, width = 0, height = 0, mip_levels = 0, mip_levels_asked = 0;
  std::uint32_t depth_bits = 0, value_bits = 0, channels = 0, value_max = 0;
  std::uint32_t map_width = 0, map_height = 0, walk = 0, receivers = 0, flags = 0;
  std::uint32_t samples = 0, isa_bytes = 0, description_bytes = 0;
  std::uint32_t more_records = 0;  ///< so many FactsRecords follow this, whose own last four are 0
};
static_assert(sizeof(FactsRecord) == 264);

struct FactsSample {
  std::array<double, 3> position{};
  std::array<float, 2> jitter{};
  float weight = 0;
  std::uint32_t reserved = 0;
};
static_assert(sizeof(FactsSample) == 40);

/// The payload of a DONE record.
struct EndRecord {
  std::uint64_t blocks = 0, tiles = 0, resident_after_bvh = 0;
  double threads = 1, seconds_bvh = 0, seconds_total = 0;
};
static_assert(sizeof(EndRecord) == 48);

}  // namespace pdsm
