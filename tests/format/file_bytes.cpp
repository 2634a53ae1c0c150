// SPDX-License-Identifier: Apache-2.0
#include "file_bytes.h"

#include <xxhash.h>

#include <span>

namespace pdsm::testing {
namespace {

struct LooseChunk {
  Bytes entry, stored;
};

std::vector<LooseChunk> take_apart(const Bytes& bytes) {
  std::vector<LooseChunk> chunks;
  for (std::size_t n = 0; n < chunk_count(bytes); ++n) {
    const auto entry = bytes.begin() + static_cast<std::ptrdiff_t>(entry_at(n));
    const auto first = bytes.begin() + get<std::int64_t>(bytes, entry_at(n) + kOffsetIn);
    chunks.push_back({Bytes(entry, entry + kEntrySize),
                      Bytes(first, first + get<std::int64_t>(bytes, entry_at(n) + kStoredIn))});
  }
  return chunks;
}

Bytes put_together(const Bytes& old_file, std::vector<LooseChunk> chunks) {
  Bytes file(old_file.begin(), old_file.begin() + kHeaderSize);
  put(file, kChunkCountAt, static_cast<std::uint32_t>(chunks.size()));
  std::size_t end = kHeaderSize + chunks.size() * kEntrySize;
  for (LooseChunk& chunk : chunks) {
    const std::size_t offset = (end + 15) / 16 * 16;
    put<std::uint64_t>(chunk.entry, kOffsetIn, offset);
    put<std::uint64_t>(chunk.entry, kStoredIn, chunk.stored.size());
    end = offset + chunk.stored.size();
    file.insert(file.end(), chunk.entry.begin(), chunk.entry.end());
  }
  for (const LooseChunk& chunk : chunks) {
    file.resize(get<std::uint64_t>(chunk.entry, kOffsetIn));
    file.insert(file.end(), chunk.stored.begin(), chunk.stored.end());
  }
  put<std::uint64_t>(file, kFileSizeAt, file.size());
  repair_checksums(file);
  return file;
}

}  // namespace

std::uint32_t chunk_count(const Bytes& bytes) {
  return get<std::uint32_t>(bytes, kChunkCountAt);
}

std::string chunk_type(const Bytes& bytes, std::size_t index) {
  return {reinterpret_cast<const char*>(bytes.data() + entry_at(index)), 4};
}

std::size_t find_chunk(const Bytes& bytes, const std::string& type) {
  std::size_t index = 0;
  while (index < chunk_count(bytes) && chunk_type(bytes, index) != type) ++index;
  return index;
}

void repair_checksums(Bytes& bytes) {
  if (bytes.size() < kHeaderSize) return;
  const std::uint64_t count = chunk_count(bytes);
  if (count * kEntrySize <= bytes.size() - kHeaderSize) {
    for (std::size_t n = 0; n < count; ++n) {
      const auto offset = get<std::uint64_t>(bytes, entry_at(n) + kOffsetIn);
      const auto size = get<std::uint64_t>(bytes, entry_at(n) + kStoredIn);
      if (offset <= bytes.size() && size <= bytes.size() - offset)
        put<std::uint64_t>(bytes, entry_at(n) + kChecksumIn, XXH3_64bits(bytes.data() + offset, size));
    }
    put<std::uint64_t>(bytes, kTableChecksumAt, XXH3_64bits(bytes.data() + kHeaderSize, count * kEntrySize));
  }
  repair_header_checksum(bytes);
}

void repair_header_checksum(Bytes& bytes) {
  put<std::uint64_t>(bytes, kHeaderChecksumAt, XXH3_64bits(bytes.data(), kHeaderChecksumAt));
}

Bytes replace_chunk(const Bytes& bytes, std::size_t index, const Bytes& stored) {
  auto chunks = take_apart(bytes);
  chunks[index].stored = stored;
  if (get<std::uint32_t>(chunks[index].entry, kEncodingIn) == 0)
    put<std::uint64_t>(chunks[index].entry, kDecodedIn, stored.size());
  return put_together(bytes, std::move(chunks));
}

Bytes insert_chunk(const Bytes& bytes, std::size_t index, const std::string& type, std::uint32_t flags,
                   const Bytes& stored) {
  LooseChunk chunk{Bytes(kEntrySize), stored};
  std::memcpy(chunk.entry.data(), type.data(), 4);
  put(chunk.entry, kFlagsIn, flags);
  put<std::uint64_t>(chunk.entry, kDecodedIn, stored.size());
  auto chunks = take_apart(bytes);
  chunks.insert(chunks.begin() + static_cast<std::ptrdiff_t>(index), chunk);
  return put_together(bytes, std::move(chunks));
}

}  // namespace pdsm::testing
