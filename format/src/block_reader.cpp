// SPDX-License-Identifier: Apache-2.0
#include "pdsm/format/block_reader.h"

#include <system_error>
#include <utility>

#include "block_codec.h"
#include "map_parser.h"
#include "mapped_file.h"
#include "pdsm/format/error.h"

namespace pdsm {

struct BlockReader::File {
  MappedFile mapped;
  ReadLimits limits;
  MapParts parts;
  std::vector<std::size_t> first_block;  ///< of each image, among all

  /// Leaves out blocks that would decode to more than all together may.
  void keep_limits() {
    std::uint64_t budget = limits.decoded_bytes;
    for (const std::size_t index : parts.blocks) {
      const std::uint64_t size = parts.table.entries[index].decoded_size;
      if (size > budget)
        parts.table.good[index] = false;
      else
        budget -= size;
    }
  }
};

BlockReader::BlockReader(std::unique_ptr<File> file) : file_(std::move(file)) {}
BlockReader::BlockReader(BlockReader&&) noexcept = default;
BlockReader& BlockReader::operator=(BlockReader&&) noexcept = default;
BlockReader::~BlockReader() = default;

std::optional<BlockReader> BlockReader::open(const std::filesystem::path& path, const ReadLimits& limits) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  try {
    std::unique_ptr<File> file(new File{MappedFile(path), limits, {}, {}});
    auto parts = parse_parts(file->mapped.bytes(), limits);
    if (!parts) return std::nullopt;
    file->parts = std::move(*parts);
    file->keep_limits();
    std::size_t next = 0;
    for (const FunctionImage& image : file->parts.frame.images) {
      file->first_block.push_back(next);
      next += std::size_t{image.blocks_across()} * image.blocks_up();
    }
    return BlockReader(std::move(file));
  } catch (const Error& error) {
    if (error.failure() != Failure::input) throw;
    return std::nullopt;
  }
}

const PenumbraMap& BlockReader::frame() const {
  return file_->parts.frame;
}

std::optional<FunctionBlock> BlockReader::read(std::uint32_t image, std::uint32_t block) const {
  const MapParts& parts = file_->parts;
  const std::size_t index = parts.blocks[file_->first_block[image] + block];
  const TableEntry& entry = parts.table.entries[index];
  const bool is_raw = entry.encoding == kEncodingRaw && entry.decoded_size == entry.stored_size;
  if (!parts.table.good[index] || entry.image != image || entry.block != block ||
      !(is_raw || entry.encoding == kEncodingPlanes))
    return std::nullopt;
  const FunctionImage& of = parts.frame.images[image];
  const std::uint32_t across = of.blocks_across();
  const auto [width, height] = block_extent(of.width, of.height, block % across, block / across);
  FunctionBlock decoded;
  if (decode_block(parts.frame.coding, width, height, entry.encoding,
                   file_->mapped.bytes().subspan(entry.offset, entry.stored_size), entry.decoded_size,
                   decoded))
    return std::nullopt;
  return decoded;
}

}  // namespace pdsm
