// SPDX-License-Identifier: Apache-2.0
#include "block_codec.h"

#include <cassert>

#include "block_planes.h"
#include "bytes.h"
#include "faults.h"
#include "file_layout.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

std::vector<std::byte> encode_raw(const FunctionBlock& block, std::uint64_t size) {
  std::vector<std::byte> bytes;
  bytes.reserve(size);
  append_value(bytes, BlockHeader{block.first.back(), block.domain_end.empty() ? 0 : kDomainEndFlag, {}});
  append_array<std::uint32_t>(bytes, block.first);
  append_array<std::uint32_t>(bytes, block.domain_end);
  append_array<std::uint32_t>(bytes, block.words);
  return bytes;
}

Verdict decode_raw(const VertexCoding& coding, std::uint64_t texel_count, std::span<const std::byte> stored,
                   FunctionBlock& block) {
  ByteReader reader(stored);
  const auto header = reader.value<BlockHeader>();
  if (!reader.ok()) return Violation{kFaultBlockSize, "a block header of 16 bytes"};
  if ((header.flags & ~kDomainEndFlag) != 0 || header.reserved != decltype(header.reserved){})
    return Violation{kFaultBlockReserved, "unknown flags and reserved words 0"};
  const bool has_domain_end = (header.flags & kDomainEndFlag) != 0;
  if (stored.size() != raw_block_size(coding, texel_count, header.vertex_count, has_domain_end))
    return Violation{kFaultBlockSize, "a block of " + std::to_string(header.vertex_count) + " vertices"};

  block.first.resize(texel_count + 1);
  block.domain_end.resize(has_domain_end ? texel_count : 0);
  block.words.resize(std::size_t{header.vertex_count} * coding.words_per_vertex());
  reader.array(std::span(block.first));
  reader.array(std::span(block.domain_end));
  reader.array(std::span(block.words));
  return {};
}

}  // namespace

std::uint64_t raw_block_size(const VertexCoding& coding, std::uint64_t texel_count,
                             std::uint64_t vertex_count, bool has_domain_end) {
  std::uint64_t words = 1;
  const bool fits = checked_add_product(texel_count, has_domain_end ? 2 : 1, words) &&
                    checked_add_product(vertex_count, coding.words_per_vertex(), words);
  std::uint64_t size = sizeof(BlockHeader);
  return fits && checked_add_product(words, sizeof(std::uint32_t), size) ? size : UINT64_MAX;
}

Verdict decode_block(const VertexCoding& coding, std::uint32_t width, std::uint32_t height,
                     std::uint32_t encoding, std::span<const std::byte> stored, std::uint64_t decoded_size,
                     FunctionBlock& block) {
  if (encoding == kEncodingRaw) {
    if (auto verdict = decode_raw(coding, std::uint64_t{width} * height, stored, block)) return verdict;
  } else if (!decompress_block(coding, width, height, stored, decoded_size, block)) {
    return Violation{kFaultDecompression, "a compressed block of " + std::to_string(decoded_size) + " bytes"};
  }
  return check_block(coding, width * height, block);
}

EncodedBlock encode_block(const VertexCoding& coding, std::uint32_t block_width, std::uint32_t block_height,
                          const FunctionBlock& block, const WriteOptions& options) {
  assert(!check_coding(coding) && !check_block(coding, block_width * block_height, block));
  EncodedBlock encoded;
  encoded.texels = std::uint64_t{block_width} * block_height;
  encoded.vertices = block.first.back();
  encoded.decoded_bytes = raw_block_size(coding, encoded.texels, encoded.vertices, !block.domain_end.empty());
  if (options.compression == Compression::zstd) {
    encoded.encoding = kEncodingPlanes;
    encoded.bytes = compress_block(coding, block_width, block);
  } else {
    encoded.encoding = kEncodingRaw;
    encoded.bytes = encode_raw(block, encoded.decoded_bytes);
  }
  return encoded;
}

FunctionBlock decode_block(const VertexCoding& coding, std::uint32_t block_width, std::uint32_t block_height,
                           const EncodedBlock& block) {
  FunctionBlock decoded;
  const auto verdict = decode_block(coding, block_width, block_height, block.encoding, block.bytes,
                                    block.decoded_bytes, decoded);
  if (verdict) throw Error(Failure::input, "block", "expected " + verdict->expected);
  return decoded;
}

}  // namespace pdsm
