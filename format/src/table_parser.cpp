// SPDX-License-Identifier: Apache-2.0
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "bytes.h"
#include "map_parser.h"

namespace pdsm {
namespace {

template <typename T>
T load(std::span<const std::byte> bytes, std::uint64_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

/// Where the fields of the header lie, for messages.
constexpr std::uint64_t kAtMajor = offsetof(FileHeader, major_version);
constexpr std::uint64_t kAtCount = offsetof(FileHeader, chunk_count);
constexpr std::uint64_t kAtSize = offsetof(FileHeader, file_size);
constexpr std::uint64_t kAtTableChecksum = offsetof(FileHeader, table_checksum);
constexpr std::uint64_t kAtHeaderChecksum = offsetof(FileHeader, header_checksum);

/// The header, once it and the size of the table hold.
std::optional<FileHeader> parse_header(std::span<const std::byte> bytes, FaultList& faults) {
  const auto fault = [&](int number, std::uint64_t offset, std::string expected) {
    faults.add(number, offset, std::move(expected));
    return std::nullopt;
  };
  const std::size_t magic_bytes = std::min(bytes.size(), kMagic.size());
  if (bytes.empty() || std::memcmp(bytes.data(), kMagic.data(), magic_bytes) != 0)
    return fault(kFaultMagic, 0, "the 12 bytes that a penumbra map begins with");
  if (bytes.size() < sizeof(FileHeader)) return fault(kFaultTooShort, bytes.size(), "a header of 48 bytes");

  const auto header = load<FileHeader>(bytes, 0);
  if (header.major_version != kFormatMajor)
    return fault(
        kFaultMajorVersion, kAtMajor,
        "major version " + std::to_string(kFormatMajor) + ", not " + std::to_string(header.major_version));
  if (header.header_checksum != XXH3_64bits(bytes.data(), kAtHeaderChecksum))
    return fault(kFaultHeaderChecksum, kAtHeaderChecksum, "the checksum of the header");
  if (header.file_size != bytes.size())
    return fault(kFaultFileSize, kAtSize,
                 std::to_string(header.file_size) + " bytes of file, not " + std::to_string(bytes.size()));
  std::uint64_t table_end = sizeof(FileHeader);
  if (!checked_add_product(header.chunk_count, sizeof(TableEntry), table_end) || table_end > bytes.size())
    return fault(kFaultTableSize, kAtCount, "a chunk table that fits the file");
  return header;
}

bool is_zero(std::span<const std::byte> bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](std::byte byte) { return byte == std::byte{0}; });
}

/// Place of one chunk behind the one before, which ended at `end`. Everything that follows relies on it.
bool check_place(std::span<const std::byte> bytes, const TableEntry& entry, std::uint64_t at,
                 std::uint64_t end, FaultList& faults) {
  if (entry.offset != align_chunk(end) || entry.offset > bytes.size()) {
    faults.add(kFaultChunkOffset, at + offsetof(TableEntry, offset),
               "a chunk right behind the one before, at " + std::to_string(align_chunk(end)));
    return false;
  }
  if (entry.stored_size > bytes.size() - entry.offset) {
    faults.add(kFaultChunkSize, at + offsetof(TableEntry, stored_size), "a chunk that ends within the file");
    return false;
  }
  return true;
}

bool is_known(const ChunkType& type) {
  return type == kMapChunk || type == kSamplesChunk || type == kMetadataChunk || type == kBlockKeysChunk ||
         type == kBlockChunk;
}

/// Flags, padding before and checksum of one well-placed chunk; false where it is not to be used.
bool check_entry(std::span<const std::byte> bytes, const TableEntry& entry, std::uint64_t at,
                 std::uint64_t end, FaultList& faults) {
  const std::size_t faults_before = faults.size();
  const bool critical = (entry.flags & kCriticalFlag) != 0;
  const bool must_be_critical = entry.type == kMapChunk || entry.type == kBlockChunk;
  if ((entry.flags & ~kCriticalFlag) != 0 || (is_known(entry.type) && critical != must_be_critical))
    faults.add(kFaultEntryFlags, at + offsetof(TableEntry, flags), "flags that suit the chunk's type");
  if (entry.reserved != 0)
    faults.add(kFaultEntryReserved, at + offsetof(TableEntry, reserved), "0 in a reserved word");
  if (!is_known(entry.type) && critical)
    faults.add(kFaultUnknownCritical, at, "a type that this version knows, for it is marked critical");
  if (!is_zero(bytes.subspan(end, entry.offset - end)))
    faults.add(kFaultPadding, end, "zeros between chunks");
  if (XXH3_64bits(bytes.data() + entry.offset, entry.stored_size) != entry.checksum)
    faults.add(kFaultChunkChecksum, entry.offset, "the checksum that the table has for this chunk");
  return faults.size() == faults_before && is_known(entry.type);
}

}  // namespace

std::optional<FileTable> parse_table(std::span<const std::byte> bytes, FaultList& faults) {
  const auto header = parse_header(bytes, faults);
  if (!header) return std::nullopt;
  const std::uint64_t table_bytes = header->chunk_count * sizeof(TableEntry);
  if (XXH3_64bits(bytes.data() + sizeof(FileHeader), table_bytes) != header->table_checksum) {
    faults.add(kFaultTableChecksum, kAtTableChecksum, "the checksum of the chunk table");
    return std::nullopt;
  }

  FileTable table;
  std::uint64_t at = sizeof(FileHeader), end = at + table_bytes;
  for (std::uint32_t n = 0; n < header->chunk_count && !faults.full(); ++n, at += sizeof(TableEntry)) {
    const auto entry = load<TableEntry>(bytes, at);
    if (!check_place(bytes, entry, at, end, faults)) return std::nullopt;
    table.entries.push_back(entry);
    table.good.push_back(check_entry(bytes, entry, at, end, faults));
    end = entry.offset + entry.stored_size;
  }
  if (end != bytes.size() && !faults.full()) faults.add(kFaultFileEnd, end, "the end of the file");
  return table;
}

}  // namespace pdsm
