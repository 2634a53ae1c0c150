// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// The fixed structures of a map file, as they lie in it. FORMAT.md sections 2 to 4.
namespace pdsm {

inline constexpr std::array<unsigned char, 12> kMagic{0xAB, 'P',  'D',  'S',  'M',  '1',
                                                      '0',  0xBB, '\r', '\n', 0x1A, '\n'};

struct FileHeader {
  std::array<unsigned char, 12> magic;
  std::uint32_t major_version, minor_version;
  std::uint32_t chunk_count;
  std::uint64_t file_size;
  std::uint64_t table_checksum;   ///< XXH3-64 of the chunk table
  std::uint64_t header_checksum;  ///< XXH3-64 of the bytes before it
};
static_assert(sizeof(FileHeader) == 48 && offsetof(FileHeader, header_checksum) == 40);

using ChunkType = std::array<char, 4>;
inline constexpr ChunkType kMapChunk{'M', 'A', 'P', 'D'};
inline constexpr ChunkType kSamplesChunk{'S', 'M', 'P', 'L'};
inline constexpr ChunkType kMetadataChunk{'M', 'E', 'T', 'A'};
inline constexpr ChunkType kBlockKeysChunk{'B', 'K', 'E', 'Y'};
inline constexpr ChunkType kBlockChunk{'B', 'L', 'C', 'K'};

inline constexpr std::uint32_t kCriticalFlag = 1;  ///< a reader that does not know the type gives up

enum ChunkEncoding : std::uint32_t {
  kEncodingRaw = 0,     ///< the payload as it is
  kEncodingZstd = 1,    ///< zstd of the payload (SMPL, META)
  kEncodingPlanes = 2,  ///< zstd of predicted byte planes (BLCK)
  kEncodingAsRed = 3,   ///< nothing: the same block of channel 0 (BLCK of other channels)
};

struct TableEntry {
  ChunkType type;
  std::uint32_t flags;
  std::uint32_t image, block;  ///< the key; 0 for what is not a block
  std::uint32_t encoding;
  std::uint32_t reserved;
  std::uint64_t offset;  ///< from the start of the file
  std::uint64_t stored_size, decoded_size;
  std::uint64_t checksum;  ///< XXH3-64 of the stored bytes
};
static_assert(sizeof(TableEntry) == 56 && offsetof(TableEntry, offset) == 24);

/// Chunks start at multiples of this, so that a mapped file can be used in place.
inline constexpr std::uint64_t kChunkAlignment = 16;

[[nodiscard]] constexpr std::uint64_t align_chunk(std::uint64_t offset) {
  return (offset + kChunkAlignment - 1) / kChunkAlignment * kChunkAlignment;
}

struct MapHeader {
  std::uint32_t view_count, layer_count, image_count;
  std::uint32_t layer_rule;
  std::uint32_t depth_bits, value_bits, channels, value_max;
};
static_assert(sizeof(MapHeader) == 32);

struct ViewRecord {
  std::array<double, 9> rotation;
  std::array<double, 3> translation;
  std::array<double, 4> window;
  double near_depth, far_depth;
  std::uint32_t projection, width, height;
  std::uint32_t reserved;
};
static_assert(sizeof(ViewRecord) == 160);

struct ImageRecord {
  std::uint32_t layer, view, level, channel;
};
static_assert(sizeof(ImageRecord) == 16);

struct SampleRecord {
  std::array<double, 3> position;
  std::array<float, 2> jitter;
  float weight;
  std::uint32_t reserved;
};
static_assert(sizeof(SampleRecord) == 40);

struct BlockKeyRecord {
  std::array<std::uint64_t, 2> inputs;
  std::uint64_t content, events;
  std::uint32_t undarkened_texels;
  std::uint32_t reserved;
};
static_assert(sizeof(BlockKeyRecord) == 40);

/// Head of a raw block; function offsets, domain ends and packed vertices follow.
struct BlockHeader {
  std::uint32_t vertex_count;
  std::uint32_t flags;
  std::array<std::uint32_t, 2> reserved;
};
static_assert(sizeof(BlockHeader) == 16);

inline constexpr std::uint32_t kDomainEndFlag = 1;  ///< the block has a domain end for each texel

}  // namespace pdsm
