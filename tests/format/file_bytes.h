// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/// Map files taken apart by the offsets that FORMAT.md gives, written down here once more, so that the
/// tests notice when code and page part.
namespace pdsm::testing {

using Bytes = std::vector<std::byte>;

inline constexpr std::size_t kHeaderSize = 48, kEntrySize = 56;
inline constexpr std::size_t kMajorAt = 12, kMinorAt = 16, kChunkCountAt = 20, kFileSizeAt = 24;
inline constexpr std::size_t kTableChecksumAt = 32, kHeaderChecksumAt = 40;
inline constexpr std::size_t kFlagsIn = 4, kImageIn = 8, kBlockIn = 12, kEncodingIn = 16, kReservedIn = 20,
                             kOffsetIn = 24, kStoredIn = 32, kDecodedIn = 40, kChecksumIn = 48;

template <typename T>
[[nodiscard]] T get(const Bytes& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}
template <typename T>
void put(Bytes& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

[[nodiscard]] std::uint32_t chunk_count(const Bytes& bytes);
[[nodiscard]] constexpr std::size_t entry_at(std::size_t index) {
  return kHeaderSize + index * kEntrySize;
}
[[nodiscard]] std::string chunk_type(const Bytes& bytes, std::size_t index);
/// Index of the first chunk of a type; chunk_count where there is none.
[[nodiscard]] std::size_t find_chunk(const Bytes& bytes, const std::string& type);

/// Makes all checksums right again that can be computed, of chunks (as far as they lie in the file), table
/// and header. Nothing else is touched.
void repair_checksums(Bytes& bytes);
/// The same for the header alone.
void repair_header_checksum(Bytes& bytes);

/// Replaces the stored bytes of a chunk, moving what follows, with sizes, offsets and checksums right.
[[nodiscard]] Bytes replace_chunk(const Bytes& bytes, std::size_t index, const Bytes& stored);

/// A file with a further chunk of a type at table position `index`.
[[nodiscard]] Bytes insert_chunk(const Bytes& bytes, std::size_t index, const std::string& type,
                                 std::uint32_t flags, const Bytes& stored);

}  // namespace pdsm::testing
