// SPDX-License-Identifier: Apache-2.0
#include <xxhash.h>

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

#include "bytes.h"
#include "file_layout.h"
#include "pdsm/format/atomic_file.h"
#include "pdsm/format/map_file.h"
#include "red_image.h"
#include "zstd_stream.h"

namespace pdsm {
namespace {

using BlocksOfImages = std::span<const std::vector<EncodedBlock>>;
using Sink = std::function<void(std::span<const std::byte>)>;

/// One chunk on its way to the file: borrowed bytes (blocks) or own ones.
struct Chunk {
  TableEntry entry{};
  std::span<const std::byte> bytes;
  std::vector<std::byte> own;
};

std::vector<std::byte> map_payload(const PenumbraMap& map) {
  std::vector<std::byte> bytes;
  const auto count = [](const auto& items) { return static_cast<std::uint32_t>(items.size()); };
  append_value(bytes, MapHeader{count(map.views), count(map.layers), count(map.images),
                                static_cast<std::uint32_t>(map.layer_rule), map.coding.depth_bits,
                                map.coding.value_bits, map.channels, map.coding.value_max});
  for (const View& view : map.views) {
    append_value(bytes, ViewRecord{view.world_to_view.rotation, view.world_to_view.translation, view.window,
                                   view.near_depth, view.far_depth,
                                   static_cast<std::uint32_t>(view.projection), view.width, view.height, 0});
  }
  for (const FunctionImage& image : map.images)
    append_value(bytes, ImageRecord{image.layer, image.view, image.level, image.channel});
  for (const std::string& layer : map.layers) {
    append_value(bytes, count(layer));
    append_array<char>(bytes, layer);
  }
  return bytes;
}

std::vector<std::byte> samples_payload(const PenumbraMap& map) {
  std::vector<std::byte> bytes;
  bytes.reserve(map.samples.size() * sizeof(SampleRecord));
  for (const LightSample& sample : map.samples)
    append_value(bytes, SampleRecord{sample.position, sample.jitter, sample.weight, 0});
  return bytes;
}

std::vector<std::byte> metadata_payload(const PenumbraMap& map) {
  std::vector<std::byte> bytes;
  append_array<char>(bytes, map.metadata);
  return bytes;
}

std::vector<std::byte> block_keys_payload(const PenumbraMap& map) {
  std::vector<std::byte> bytes;
  bytes.reserve(map.block_keys.size() * sizeof(BlockKeyRecord));
  for (const BlockKey& key : map.block_keys)
    append_value(bytes, BlockKeyRecord{key.inputs, key.content, key.events, key.undarkened_texels, 0});
  return bytes;
}

/// A chunk that owns its bytes.
Chunk make_chunk(ChunkType type, std::uint32_t flags, std::vector<std::byte> payload,
                 Compression compression) {
  Chunk chunk;
  chunk.entry.type = type;
  chunk.entry.flags = flags;
  chunk.entry.decoded_size = payload.size();
  chunk.entry.encoding = compression == Compression::zstd ? kEncodingZstd : kEncodingRaw;
  chunk.own = compression == Compression::zstd ? compress_parts(std::span(&payload, 1)) : std::move(payload);
  chunk.bytes = chunk.own;
  return chunk;
}

Chunk block_chunk(std::size_t image, std::size_t block, const EncodedBlock& encoded) {
  Chunk chunk;
  chunk.entry.type = kBlockChunk;
  chunk.entry.flags = kCriticalFlag;
  chunk.entry.image = static_cast<std::uint32_t>(image);
  chunk.entry.block = static_cast<std::uint32_t>(block);
  chunk.entry.encoding = encoded.encoding;
  chunk.entry.decoded_size = encoded.decoded_bytes;
  chunk.bytes = encoded.bytes;
  return chunk;
}

/// A block that is the same as that of channel 0 takes no bytes.
Chunk block_chunk(const PenumbraMap& map, BlocksOfImages blocks, std::size_t image, std::size_t block) {
  const EncodedBlock& encoded = blocks[image][block];
  Chunk chunk = block_chunk(image, block, encoded);
  const auto red = red_image(map, image);
  if (!red) return chunk;
  const EncodedBlock& same = blocks[*red][block];
  if (same.encoding != encoded.encoding || same.bytes != encoded.bytes) return chunk;
  chunk.entry.encoding = kEncodingAsRed;
  chunk.bytes = {};
  return chunk;
}

/// All chunks in file order. What is not a block is compressed when the blocks are.
std::vector<Chunk> make_chunks(const PenumbraMap& map, BlocksOfImages blocks) {
  const bool any_compressed = std::any_of(blocks.begin(), blocks.end(), [](const auto& image) {
    return std::any_of(image.begin(), image.end(),
                       [](const EncodedBlock& block) { return block.encoding != kEncodingRaw; });
  });
  const Compression compression = any_compressed ? Compression::zstd : Compression::none;

  std::vector<Chunk> chunks;
  chunks.push_back(make_chunk(kMapChunk, kCriticalFlag, map_payload(map), Compression::none));
  if (!map.samples.empty()) chunks.push_back(make_chunk(kSamplesChunk, 0, samples_payload(map), compression));
  chunks.push_back(make_chunk(kMetadataChunk, 0, metadata_payload(map), compression));
  // Hashes can't be compressed.
  if (!map.block_keys.empty())
    chunks.push_back(make_chunk(kBlockKeysChunk, 0, block_keys_payload(map), Compression::none));
  for (std::size_t image = 0; image < blocks.size(); ++image) {
    for (std::size_t block = 0; block < blocks[image].size(); ++block)
      chunks.push_back(block_chunk(map, blocks, image, block));
  }
  return chunks;
}

/// Gives each chunk its place and checksum; returns the size of the file.
std::uint64_t place_chunks(std::vector<Chunk>& chunks) {
  std::uint64_t end = sizeof(FileHeader) + chunks.size() * sizeof(TableEntry);
  for (Chunk& chunk : chunks) {
    chunk.entry.offset = align_chunk(end);
    chunk.entry.stored_size = chunk.bytes.size();
    chunk.entry.checksum = XXH3_64bits(chunk.bytes.data(), chunk.bytes.size());
    end = chunk.entry.offset + chunk.entry.stored_size;
  }
  return end;
}

/// Header and table.
std::vector<std::byte> file_front(const std::vector<Chunk>& chunks, std::uint64_t file_size) {
  std::vector<std::byte> table;
  for (const Chunk& chunk : chunks) append_value(table, chunk.entry);
  FileHeader header{
      kMagic, kFormatMajor, kFormatMinor, static_cast<std::uint32_t>(chunks.size()), file_size, 0, 0};
  header.table_checksum = XXH3_64bits(table.data(), table.size());
  header.header_checksum = XXH3_64bits(&header, offsetof(FileHeader, header_checksum));
  std::vector<std::byte> front;
  append_value(front, header);
  append_array<std::byte>(front, table);
  return front;
}

/// Tells the whole file to `sink`, piece by piece; returns its size.
std::uint64_t emit(const PenumbraMap& map, BlocksOfImages blocks, const Sink& sink) {
  std::vector<Chunk> chunks = make_chunks(map, blocks);
  const std::uint64_t file_size = place_chunks(chunks);
  const std::vector<std::byte> front = file_front(chunks, file_size);
  sink(front);

  std::uint64_t position = front.size();
  constexpr std::array<std::byte, kChunkAlignment> kZeros{};
  for (const Chunk& chunk : chunks) {
    sink(std::span(kZeros).first(chunk.entry.offset - position));
    sink(chunk.bytes);
    position = chunk.entry.offset + chunk.entry.stored_size;
  }
  return file_size;
}

std::vector<std::vector<EncodedBlock>> encode_blocks(const PenumbraMap& map, const WriteOptions& options) {
  std::vector<std::vector<EncodedBlock>> blocks;
  for (const FunctionImage& image : map.images) {
    auto& encoded = blocks.emplace_back();
    for (std::uint32_t b = 0; b < image.blocks.size(); ++b) {
      const auto [width, height] =
          block_extent(image.width, image.height, b % image.blocks_across(), b / image.blocks_across());
      encoded.push_back(encode_block(map.coding, width, height, image.blocks[b], options));
    }
  }
  return blocks;
}

/// Collects small pieces, so that a file of many chunks does not take two system calls for each.
class BufferedFile {
 public:
  explicit BufferedFile(AtomicFile& file) : file_(file) {}

  void write(std::span<const std::byte> bytes) {
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    if (buffer_.size() >= kBufferBytes) flush();
  }
  void flush() {
    file_.write(buffer_);
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kBufferBytes = 1 << 20;
  AtomicFile& file_;
  std::vector<std::byte> buffer_;
};

}  // namespace

std::uint64_t write_encoded_map(const PenumbraMap& map, std::span<const std::vector<EncodedBlock>> blocks,
                                const std::filesystem::path& path) {
  assert(blocks.size() == map.images.size());
  AtomicFile file(path);
  BufferedFile buffered(file);
  const std::uint64_t size =
      emit(map, blocks, [&](std::span<const std::byte> bytes) { buffered.write(bytes); });
  buffered.flush();
  file.commit();
  return size;
}

std::uint64_t encoded_map_bytes(const PenumbraMap& map, std::span<const std::vector<EncodedBlock>> blocks) {
  assert(blocks.size() == map.images.size());
  std::vector<Chunk> chunks = make_chunks(map, blocks);
  return place_chunks(chunks);
}

std::uint64_t write_map(const PenumbraMap& map, const std::filesystem::path& path,
                        const WriteOptions& options) {
  assert(find_invariant_fault(map).empty());
  return write_encoded_map(map, encode_blocks(map, options), path);
}

std::vector<std::byte> serialize_map(const PenumbraMap& map, const WriteOptions& options) {
  assert(find_invariant_fault(map).empty());
  std::vector<std::byte> bytes;
  emit(map, encode_blocks(map, options),
       [&](std::span<const std::byte> piece) { bytes.insert(bytes.end(), piece.begin(), piece.end()); });
  return bytes;
}

}  // namespace pdsm
