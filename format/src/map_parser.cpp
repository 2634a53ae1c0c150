// SPDX-License-Identifier: Apache-2.0
#include "map_parser.h"

#include <algorithm>
#include <limits>
#include <string>

#include "block_codec.h"
#include "bytes.h"
#include "invariants.h"
#include "red_image.h"
#include "zstd_stream.h"

namespace pdsm {
namespace {

std::uint64_t entry_offset(std::size_t index) {
  return sizeof(FileHeader) + index * sizeof(TableEntry);
}

/// One pass over a file; members are what the steps share.
class MapParser {
 public:
  MapParser(std::span<const std::byte> bytes, const ReadLimits& limits, FaultList& faults)
      : bytes_(bytes), budget_(limits.decoded_bytes), faults_(faults) {}

  /// An empty sink: without a look into the blocks.
  PenumbraMap parse(const BlockSink& sink);
  /// As parse_parts(); faults are of no matter.
  std::optional<MapParts> parse_parts();

 private:
  [[nodiscard]] std::span<const std::byte> stored(std::size_t index) const {
    return bytes_.subspan(table_.entries[index].offset, table_.entries[index].stored_size);
  }
  bool check_order();
  bool check_entry_form(std::size_t index);
  bool take_budget(std::size_t index);
  std::optional<std::vector<std::byte>> plain_payload(std::size_t index);
  bool parse_map_chunk(std::size_t index);
  void parse_images(ByteReader& reader, std::uint32_t count);
  bool parse_layers(ByteReader& reader, std::uint32_t count, std::uint64_t at);
  void parse_samples(std::size_t index);
  void parse_metadata(std::size_t index);
  bool parse_block_keys(std::size_t index);
  bool count_blocks();
  void parse_blocks(const BlockSink& sink);
  void parse_block(std::size_t index, std::size_t image, std::uint32_t block, const BlockSink& sink);
  std::optional<std::size_t> find_content(std::size_t index, std::size_t image, std::uint32_t block);

  bool fault(int number, std::uint64_t offset, std::string expected) {
    faults_.add(number, offset, std::move(expected));
    return false;
  }

  std::span<const std::byte> bytes_;
  std::uint64_t budget_;  ///< bytes that may still be decoded
  FaultList& faults_;
  FileTable table_;
  std::vector<std::size_t> blocks_;       ///< entries of BLCK chunks
  std::vector<std::size_t> first_block_;  ///< of each image, among them
  PenumbraMap map_;
};

/// MAPD, SMPL, META, BKEY, BLCK in this order, the first once, the next three at most once.
bool MapParser::check_order() {
  constexpr std::array kOrder{kMapChunk, kSamplesChunk, kMetadataChunk, kBlockKeysChunk, kBlockChunk};
  std::size_t rank = 0;  // of the next type that may come
  for (std::size_t n = 0; n < table_.entries.size(); ++n) {
    const auto found = std::find(kOrder.begin(), kOrder.end(), table_.entries[n].type);
    if (found == kOrder.end()) continue;
    const auto type = static_cast<std::size_t>(found - kOrder.begin());
    if (type < rank || (rank == 0 && type != 0))
      return fault(kFaultChunkOrder, entry_offset(n), "chunks in the order MAPD, SMPL, META, BKEY, BLCK");
    rank = *found == kBlockChunk ? type : type + 1;
    if (*found == kBlockChunk) blocks_.push_back(n);
  }
  if (rank == 0) return fault(kFaultChunkOrder, sizeof(FileHeader), "a MAPD chunk");
  return true;
}

/// Key, encoding and decoded size as far as they follow from the type.
bool MapParser::check_entry_form(std::size_t index) {
  const TableEntry& entry = table_.entries[index];
  const std::uint64_t at = entry_offset(index);
  const bool is_block = entry.type == kBlockChunk;
  if (!is_block && (entry.image != 0 || entry.block != 0))
    return fault(kFaultChunkKey, at + offsetof(TableEntry, image), "key 0 of what is not a block");
  const bool may_be_zstd = entry.type == kSamplesChunk || entry.type == kMetadataChunk;
  if (entry.encoding != kEncodingRaw && !(may_be_zstd && entry.encoding == kEncodingZstd) &&
      !(is_block && (entry.encoding == kEncodingPlanes || entry.encoding == kEncodingAsRed)))
    return fault(kFaultEncoding, at + offsetof(TableEntry, encoding), "an encoding that suits the type");
  if (entry.encoding == kEncodingRaw && entry.decoded_size != entry.stored_size)
    return fault(kFaultDecodedSize, at + offsetof(TableEntry, decoded_size), "the stored size");
  return true;
}

bool MapParser::take_budget(std::size_t index) {
  const std::uint64_t size = table_.entries[index].decoded_size;
  if (size > budget_)
    return fault(kFaultLimit, entry_offset(index) + offsetof(TableEntry, decoded_size),
                 "decoded chunks within the limit of memory");
  budget_ -= size;
  return true;
}

/// Payload of a chunk that is not a block.
std::optional<std::vector<std::byte>> MapParser::plain_payload(std::size_t index) {
  if (!check_entry_form(index) || !take_budget(index)) return std::nullopt;
  const TableEntry& entry = table_.entries[index];
  const auto bytes = stored(index);
  if (entry.encoding == kEncodingRaw) return std::vector<std::byte>(bytes.begin(), bytes.end());
  std::vector<std::byte> payload;
  ZstdReader reader(bytes);
  if (!reader.append(payload, entry.decoded_size) || !reader.at_end()) {
    fault(kFaultDecompression, entry.offset, "a zstd frame of the decoded size");
    return std::nullopt;
  }
  return payload;
}

void MapParser::parse_images(ByteReader& reader, std::uint32_t count) {
  for (std::uint32_t n = 0; n < count; ++n) {
    const auto record = reader.value<ImageRecord>();
    FunctionImage& image = map_.images.emplace_back();
    image.layer = record.layer;
    image.view = record.view;
    image.channel = record.channel;
    image.level = record.level;
    if (record.view >= map_.views.size() || record.level > 31) continue;  // check_images tells
    image.width = std::max(1U, map_.views[record.view].width >> record.level);
    image.height = std::max(1U, map_.views[record.view].height >> record.level);
  }
}

bool MapParser::parse_layers(ByteReader& reader, std::uint32_t count, std::uint64_t at) {
  map_.layers.clear();
  for (std::uint32_t n = 0; n < count; ++n) {
    const auto length = reader.value<std::uint32_t>();
    if (!reader.ok() || length > std::min<std::size_t>(kMaxLayerName, reader.remaining()))
      return fault(kFaultLayer, at, "layer names of 1 to 255 bytes within the chunk");
    std::string& name = map_.layers.emplace_back(length, '\0');
    reader.array(std::span<char>(name));
  }
  if (reader.remaining() != 0) return fault(kFaultMapSize, at, "a MAPD chunk that ends with its layers");
  return true;
}

bool MapParser::parse_map_chunk(std::size_t index) {
  const std::uint64_t at = table_.entries[index].offset;
  if (!check_entry_form(index) || !take_budget(index)) return false;
  ByteReader reader(stored(index));
  const auto header = reader.value<MapHeader>();
  std::uint64_t least = sizeof(MapHeader);
  if (!reader.ok() || !checked_add_product(header.view_count, sizeof(ViewRecord), least) ||
      !checked_add_product(header.image_count, sizeof(ImageRecord), least) ||
      !checked_add_product(header.layer_count, sizeof(std::uint32_t), least) || least > stored(index).size())
    return fault(kFaultMapSize, at, "a MAPD chunk that holds its views, images and layers");

  const auto check = [&](const Verdict& verdict) {
    return !verdict || fault(verdict->number, at, verdict->expected);
  };
  map_.coding = {header.depth_bits, header.value_bits, header.value_max};
  map_.channels = header.channels;
  if (!check(check_coding(map_.coding)) || !check(check_channels(map_.channels))) return false;
  if (header.view_count == 0) return fault(kFaultView, at, "one view or more");
  for (std::uint32_t n = 0; n < header.view_count; ++n) {
    const auto record = reader.value<ViewRecord>();
    if (record.reserved != 0) return fault(kFaultMapReserved, at, "0 in a reserved word of a view");
    map_.views.push_back({{record.rotation, record.translation},
                          static_cast<Projection>(record.projection),
                          record.window,
                          record.near_depth,
                          record.far_depth,
                          record.width,
                          record.height});
    if (!check(check_view(map_.views.back(), map_.coding))) return false;
  }
  map_.layer_rule = static_cast<LayerRule>(header.layer_rule);
  parse_images(reader, header.image_count);
  return parse_layers(reader, header.layer_count, at) && check(check_layers(map_)) &&
         check(check_images(map_));
}

void MapParser::parse_samples(std::size_t index) {
  const auto payload = plain_payload(index);
  if (!payload) return;
  const std::uint64_t at = table_.entries[index].offset;
  if (payload->size() % sizeof(SampleRecord) != 0) {
    fault(kFaultSample, at, "light samples of 40 bytes");
    return;
  }
  ByteReader reader(*payload);
  while (reader.remaining() > 0) {
    const auto record = reader.value<SampleRecord>();
    map_.samples.push_back({record.position, record.jitter, record.weight});
    auto verdict = check_sample(map_.samples.back());
    if (!verdict && record.reserved != 0) verdict = Violation{kFaultSample, "0 in a reserved word"};
    if (!verdict) continue;
    fault(verdict->number, at, verdict->expected);
    return;
  }
}

void MapParser::parse_metadata(std::size_t index) {
  const auto payload = plain_payload(index);
  if (!payload) return;
  map_.metadata.assign(reinterpret_cast<const char*>(payload->data()), payload->size());
  if (const auto verdict = check_metadata(map_.metadata))
    fault(verdict->number, table_.entries[index].offset, verdict->expected);
}

bool MapParser::parse_block_keys(std::size_t index) {
  const auto payload = plain_payload(index);
  if (!payload) return false;
  const std::uint64_t at = table_.entries[index].offset;
  if (payload->empty() || payload->size() % sizeof(BlockKeyRecord) != 0)
    return fault(kFaultBlockKeys, at, "block keys of 40 bytes, one or more");
  ByteReader reader(*payload);
  while (reader.remaining() > 0) {
    const auto record = reader.value<BlockKeyRecord>();
    if (record.reserved != 0) return fault(kFaultBlockKeys, at, "0 in a reserved word of a block key");
    map_.block_keys.push_back({record.inputs, record.content, record.events, record.undarkened_texels});
  }
  const auto verdict = check_block_keys(map_);
  return !verdict || fault(verdict->number, at, verdict->expected);
}

/// Whether there is one BLCK chunk for each block of each image.
bool MapParser::count_blocks() {
  std::uint64_t expected = 0;
  bool fits = true;
  for (const FunctionImage& image : map_.images) {
    first_block_.push_back(expected);
    fits = fits && checked_add_product(image.blocks_across(), image.blocks_up(), expected);
  }
  if (!fits || expected != blocks_.size())
    return fault(kFaultBlockCount, offsetof(FileHeader, chunk_count),
                 (fits ? std::to_string(expected) : std::string("fewer")) + " BLCK chunks, not " +
                     std::to_string(blocks_.size()));
  return true;
}

/// The entry that has a block's bytes: its own, or that of channel 0.
std::optional<std::size_t> MapParser::find_content(std::size_t index, std::size_t image,
                                                   std::uint32_t block) {
  const TableEntry& entry = table_.entries[index];
  if (entry.encoding != kEncodingAsRed) return index;
  const auto red = red_image(map_, image);
  if (!red || entry.stored_size != 0) {
    fault(kFaultEncoding, entry_offset(index) + offsetof(TableEntry, encoding),
          "an empty chunk of another channel than 0, which has the block");
    return std::nullopt;
  }
  const std::size_t content = blocks_[first_block_[*red] + block];
  // What is wrong there has been told.
  if (!table_.good[content] || table_.entries[content].encoding == kEncodingAsRed) return std::nullopt;
  if (entry.decoded_size == table_.entries[content].decoded_size) return content;
  fault(kFaultDecodedSize, entry_offset(index) + offsetof(TableEntry, decoded_size),
        "the decoded size of channel 0's block");
  return std::nullopt;
}

void MapParser::parse_block(std::size_t index, std::size_t image_index, std::uint32_t block,
                            const BlockSink& sink) {
  const TableEntry& entry = table_.entries[index];
  if (entry.image != image_index || entry.block != block) {
    fault(kFaultChunkKey, entry_offset(index) + offsetof(TableEntry, image),
          "key image " + std::to_string(image_index) + ", block " + std::to_string(block));
    return;
  }
  if (!table_.good[index] || !check_entry_form(index) || !take_budget(index)) return;
  const auto content = find_content(index, image_index, block);
  if (!content) return;
  const FunctionImage& image = map_.images[image_index];
  const std::uint32_t across = image.blocks_across();
  const auto [width, height] = block_extent(image.width, image.height, block % across, block / across);
  FunctionBlock decoded;
  if (const auto verdict = decode_block(map_.coding, width, height, table_.entries[*content].encoding,
                                        stored(*content), entry.decoded_size, decoded)) {
    fault(verdict->number, entry.offset, verdict->expected);
    return;
  }
  sink(image_index, block, std::move(decoded));
}

void MapParser::parse_blocks(const BlockSink& sink) {
  std::size_t next = 0;
  for (std::size_t image = 0; image < map_.images.size(); ++image) {
    const std::uint32_t count = map_.images[image].blocks_across() * map_.images[image].blocks_up();
    for (std::uint32_t block = 0; block < count && !faults_.full(); ++block)
      parse_block(blocks_[next++], image, block, sink);
  }
}

PenumbraMap MapParser::parse(const BlockSink& sink) {
  auto table = parse_table(bytes_, faults_);
  if (!table || faults_.full()) return {};
  table_ = std::move(*table);
  if (!check_order()) return {};

  bool map_is_good = false;
  for (std::size_t n = 0; n < table_.entries.size() && !faults_.full(); ++n) {
    if (!table_.good[n]) continue;
    const ChunkType type = table_.entries[n].type;
    if (type == kMapChunk) map_is_good = parse_map_chunk(n);
    if (type == kSamplesChunk) parse_samples(n);
    if (type == kMetadataChunk) parse_metadata(n);
    if (type == kBlockKeysChunk && map_is_good) parse_block_keys(n);
  }
  if (map_is_good && !faults_.full() && count_blocks() && sink) parse_blocks(sink);
  return std::move(map_);
}

std::optional<MapParts> MapParser::parse_parts() {
  auto table = parse_table(bytes_, faults_);
  if (!table) return std::nullopt;
  table_ = std::move(*table);
  if (!check_order()) return std::nullopt;
  bool map_is_good = false;
  for (std::size_t n = 0; n < table_.entries.size(); ++n) {
    if (!table_.good[n]) continue;
    if (table_.entries[n].type == kMapChunk) map_is_good = parse_map_chunk(n);
    if (table_.entries[n].type == kBlockKeysChunk && map_is_good && !parse_block_keys(n))
      map_.block_keys.clear();
  }
  if (!map_is_good || !count_blocks()) return std::nullopt;
  return MapParts{std::move(map_), std::move(table_), std::move(blocks_)};
}

}  // namespace

PenumbraMap parse_map(std::span<const std::byte> bytes, const ReadLimits& limits, FaultList& faults,
                      const BlockSink& sink) {
  return MapParser(bytes, limits, faults).parse(sink);
}

PenumbraMap parse_frame(std::span<const std::byte> bytes, const ReadLimits& limits, FaultList& faults) {
  return MapParser(bytes, limits, faults).parse({});
}

std::optional<MapParts> parse_parts(std::span<const std::byte> bytes, const ReadLimits& limits) {
  // All faults, for damaged blocks are many.
  FaultList faults(std::numeric_limits<std::size_t>::max());
  return MapParser(bytes, limits, faults).parse_parts();
}

}  // namespace pdsm
