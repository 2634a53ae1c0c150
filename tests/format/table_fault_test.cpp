// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <zstd.h>

#include <limits>

#include "allocation_watch.h"
#include "fault_expectation.h"
#include "pdsm/format/error.h"
#include "random_map.h"
#include "scratch_folder.h"

/// Faults of header, table and compressed chunks, one test each: the number of FORMAT.md section 8, and
/// where it is seen.
namespace pdsm {
namespace {

using testing::Bytes;
using testing::entry_at;
using testing::expect_fault;
using testing::find_chunk;
using testing::get;
using testing::payload_at;
using testing::put;
using testing::sample_file;
using testing::sample_map;

constexpr std::uint64_t kTerabyte = std::uint64_t{1} << 40;
/// What the reader may allocate in one piece for a tiny file.
constexpr std::size_t kSmallAllocation = 1 << 18;

/// The sample file with one value of an entry of the table changed.
template <typename T>
Bytes with_entry(std::size_t index, std::size_t field, T value) {
  Bytes file = sample_file();
  put<T>(file, entry_at(index) + field, value);
  return file;
}

TEST(Fault, TooShort) {
  Bytes file = sample_file();
  file.resize(47);
  expect_fault(file, 1, 47);
}

TEST(Fault, Magic) {
  Bytes file = sample_file();
  file[11] = std::byte{'\r'};
  expect_fault(file, 2, 0);
}

TEST(Fault, MajorVersion) {
  Bytes file = sample_file();
  put<std::uint32_t>(file, testing::kMajorAt, 2);
  expect_fault(file, 3, testing::kMajorAt);
}

TEST(Fault, NewerMinorVersionIsRead) {
  Bytes file = sample_file();
  put<std::uint32_t>(file, testing::kMinorAt, 7);
  testing::repair_checksums(file);
  EXPECT_EQ(read_map(file, "name"), sample_map());
}

TEST(Fault, HeaderChecksum) {
  Bytes file = sample_file();
  file[testing::kHeaderChecksumAt] ^= std::byte{1};
  expect_fault(file, 4, testing::kHeaderChecksumAt, false);
}

TEST(Fault, FileSize) {
  Bytes file = sample_file();
  put<std::uint64_t>(file, testing::kFileSizeAt, kTerabyte);
  expect_fault(file, 5, testing::kFileSizeAt);
}

TEST(Fault, TableSize) {
  Bytes file = sample_file();
  put<std::uint32_t>(file, testing::kChunkCountAt, std::numeric_limits<std::uint32_t>::max());
  expect_fault(file, 6, testing::kChunkCountAt);
}

TEST(Fault, TableChecksum) {
  Bytes file = sample_file();
  file[testing::kTableChecksumAt] ^= std::byte{1};
  testing::repair_header_checksum(file);
  expect_fault(file, 7, testing::kTableChecksumAt, false);
}

TEST(Fault, EntryFlags) {
  expect_fault(with_entry<std::uint32_t>(0, testing::kFlagsIn, 3), 20, entry_at(0) + testing::kFlagsIn);
  expect_fault(with_entry<std::uint32_t>(0, testing::kFlagsIn, 0), 20, entry_at(0) + testing::kFlagsIn);
  expect_fault(with_entry<std::uint32_t>(1, testing::kFlagsIn, 1), 20, entry_at(1) + testing::kFlagsIn);
}

TEST(Fault, EntryReserved) {
  expect_fault(with_entry<std::uint32_t>(1, testing::kReservedIn, 1), 21, entry_at(1) + testing::kReservedIn);
}

TEST(Fault, ChunkOffsets) {
  const auto offset = get<std::uint64_t>(sample_file(), entry_at(2) + testing::kOffsetIn);
  // Overlapping, decreasing, leaving a gap, past the end, overflowing.
  for (std::uint64_t wrong : {offset - 16, std::uint64_t{0}, offset + 16, kTerabyte, ~std::uint64_t{15}}) {
    expect_fault(with_entry<std::uint64_t>(2, testing::kOffsetIn, wrong), 22,
                 entry_at(2) + testing::kOffsetIn);
  }
}

TEST(Fault, ChunkSizes) {
  const std::size_t last = testing::chunk_count(sample_file()) - 1;
  const auto size = get<std::uint64_t>(sample_file(), entry_at(last) + testing::kStoredIn);
  for (std::uint64_t wrong : {size + 1, kTerabyte, ~std::uint64_t{0}}) {
    expect_fault(with_entry<std::uint64_t>(last, testing::kStoredIn, wrong), 23,
                 entry_at(last) + testing::kStoredIn);
  }
}

TEST(Fault, FileEnd) {
  Bytes file = sample_file();
  const std::size_t end = file.size();
  file.resize(end + 4);
  put<std::uint64_t>(file, testing::kFileSizeAt, file.size());
  expect_fault(file, 24, end);
}

TEST(Fault, UnknownCriticalChunk) {
  const Bytes file = testing::insert_chunk(sample_file(), 2, "WHAT", 1, Bytes(5));
  expect_fault(file, 25, entry_at(2));
}

TEST(Fault, UnknownOptionalChunksAreSkipped) {
  Bytes file = sample_file();
  for (std::size_t index : {0U, 3U, 6U})
    file = testing::insert_chunk(file, std::min<std::size_t>(index, testing::chunk_count(file)), "what", 0,
                                 Bytes(5, std::byte{9}));
  EXPECT_TRUE(check_map(file).empty());
  EXPECT_EQ(read_map(file, "name"), sample_map());
  EXPECT_EQ(list_chunks(file).size(), list_chunks(sample_file()).size() + 3);
}

TEST(Fault, OptionalChunksMayBeMissing) {
  // Renamed to types that no reader knows.
  Bytes file = sample_file();
  file[entry_at(1)] = std::byte{'x'};
  file[entry_at(2)] = std::byte{'x'};
  testing::repair_checksums(file);
  PenumbraMap expected = sample_map();
  expected.samples.clear();
  expected.metadata = "{}";
  EXPECT_EQ(read_map(file, "name"), expected);
}

TEST(Fault, ChunkOrder) {
  expect_fault(testing::insert_chunk(sample_file(), 0, "META", 0, Bytes(2)), 26, entry_at(0));
  expect_fault(testing::insert_chunk(sample_file(), 1, "META", 0, Bytes(2)), 26, entry_at(2));
  expect_fault(testing::insert_chunk(sample_file(), 2, "BKEY", 0, Bytes(40)), 26, entry_at(3));
  expect_fault(testing::insert_chunk(sample_file(), 1, "MAPD", 1, Bytes(2)), 26, entry_at(1));
  Bytes empty = sample_file();
  empty.resize(testing::kHeaderSize);
  put<std::uint32_t>(empty, testing::kChunkCountAt, 0);
  put<std::uint64_t>(empty, testing::kFileSizeAt, empty.size());
  expect_fault(empty, 26, testing::kHeaderSize);
}

TEST(Fault, ChunkKeys) {
  expect_fault(with_entry<std::uint32_t>(1, testing::kBlockIn, 1), 27, entry_at(1) + testing::kImageIn);
  const std::size_t second = find_chunk(sample_file(), "BLCK") + 1;
  expect_fault(with_entry<std::uint32_t>(second, testing::kBlockIn, 0), 27,
               entry_at(second) + testing::kImageIn);
  expect_fault(with_entry<std::uint32_t>(second, testing::kImageIn, 1), 27,
               entry_at(second) + testing::kImageIn);
}

TEST(Fault, Encodings) {
  const std::size_t block = find_chunk(sample_file(), "BLCK");
  expect_fault(with_entry<std::uint32_t>(0, testing::kEncodingIn, 1), 28, entry_at(0) + testing::kEncodingIn);
  expect_fault(with_entry<std::uint32_t>(2, testing::kEncodingIn, 2), 28, entry_at(2) + testing::kEncodingIn);
  expect_fault(with_entry<std::uint32_t>(block, testing::kEncodingIn, 1), 28,
               entry_at(block) + testing::kEncodingIn);
}

/// A file of three equal channels of one block, and its entry of the green one.
Bytes file_of_equal_channels() {
  PenumbraMap map = testing::random_map(7);
  map.channels = 3;
  for (std::uint32_t channel : {1U, 2U}) {
    map.images.push_back(map.images[0]);
    map.images.back().channel = channel;
  }
  return serialize_map(map);
}

TEST(Fault, BlocksThatAreTheSameAsRed) {
  const Bytes file = file_of_equal_channels();
  ASSERT_TRUE(check_map(file).empty());
  const std::size_t red = find_chunk(file, "BLCK"), green = red + 1;
  ASSERT_EQ(get<std::uint32_t>(file, entry_at(green) + testing::kEncodingIn), 3U);
  ASSERT_EQ(get<std::uint64_t>(file, entry_at(green) + testing::kStoredIn), 0U);

  // Red can't be as red; then what green is can't be told, and isn't.
  Bytes no_red = file;
  put<std::uint32_t>(no_red, entry_at(red) + testing::kEncodingIn, 3);
  testing::repair_checksums(no_red);
  expect_fault(no_red, 28, entry_at(red) + testing::kEncodingIn);
  expect_fault(testing::replace_chunk(file, green, Bytes(1)), 28, entry_at(green) + testing::kEncodingIn);
  Bytes other_size = file;
  put<std::uint64_t>(other_size, entry_at(green) + testing::kDecodedIn, 1);
  testing::repair_checksums(other_size);
  expect_fault(other_size, 29, entry_at(green) + testing::kDecodedIn);
}

TEST(Fault, DecodedSizes) {
  expect_fault(with_entry<std::uint64_t>(2, testing::kDecodedIn, 1), 29, entry_at(2) + testing::kDecodedIn);
}

TEST(Fault, Limit) {
  const Bytes file = sample_file();
  std::uint64_t total = 0;
  for (const ChunkSummary& chunk : list_chunks(file)) total += chunk.decoded_bytes;
  EXPECT_TRUE(check_map(file, {total}).empty());
  const auto faults = check_map(file, {total - 1});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].number, 30);
  EXPECT_THROW(static_cast<void>(read_map(file, "name", {total - 1})), Error);
}

TEST(Fault, Padding) {
  Bytes file = sample_file();
  const auto end = get<std::uint64_t>(file, entry_at(2) + testing::kOffsetIn) +
                   get<std::uint64_t>(file, entry_at(2) + testing::kStoredIn);
  ASSERT_NE(end % 16, 0U);
  file[end] = std::byte{1};
  expect_fault(file, 31, end);
}

TEST(Fault, ChunkChecksum) {
  Bytes file = sample_file();
  const std::size_t at = payload_at(file, "META");
  file[at] ^= std::byte{1};
  expect_fault(file, 32, at, false);
}

TEST(Fault, EveryFaultIsListedInFileOrder) {
  Bytes file = sample_file();
  const std::size_t block = payload_at(file, "BLCK"), metadata = payload_at(file, "META");
  file[block + 20] ^= std::byte{1};
  file[metadata] ^= std::byte{1};
  file[payload_at(file, "SMPL") + 40 * 5 - 1] ^= std::byte{1};
  const auto faults = check_map(file);
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_EQ(faults[0].offset, payload_at(file, "SMPL"));
  EXPECT_EQ(faults[1].offset, metadata);
  EXPECT_EQ(faults[2].offset, block);
}

TEST(Fault, Decompression) {
  Bytes file = sample_file(Compression::zstd);
  for (const char* type : {"META", "BLCK"}) {
    Bytes damaged = file;
    const std::size_t at = payload_at(damaged, type);
    damaged[at] ^= std::byte{1};
    expect_fault(damaged, 33, at);
  }
}

TEST(Fault, BytesBehindACompressedChunk) {
  const Bytes file = sample_file(Compression::zstd);
  for (const char* type : {"META", "BLCK"}) {
    const std::size_t index = find_chunk(file, type);
    const auto first = file.begin() + static_cast<std::ptrdiff_t>(payload_at(file, type));
    Bytes stored(first, first + get<std::int64_t>(file, entry_at(index) + testing::kStoredIn));
    stored.push_back(std::byte{0});
    expect_fault(testing::replace_chunk(file, index, stored), 33, payload_at(file, type));
  }
}

TEST(Fault, DecodedSizeOfCompressedChunks) {
  const Bytes file = sample_file(Compression::zstd);
  for (const char* type : {"META", "BLCK"}) {
    const std::size_t entry = entry_at(find_chunk(file, type));
    const auto size = get<std::uint64_t>(file, entry + testing::kDecodedIn);
    for (std::uint64_t wrong : {size - 1, size + 1, std::uint64_t{1} << 32, std::uint64_t{0}}) {
      Bytes damaged = file;
      put<std::uint64_t>(damaged, entry + testing::kDecodedIn, wrong);
      const testing::AllocationWatch watch;
      expect_fault(damaged, 33, payload_at(damaged, type));
      EXPECT_LT(watch.largest(), kSmallAllocation);
    }
  }
}

/// A block that says it has 2^31 vertices and agrees with the table, but has not.
TEST(Fault, TinyFileThatClaimsGigabytesAllocatesLittle) {
  testing::MapShape shape;
  shape.width = shape.height = 1;
  const PenumbraMap map = testing::random_map(22, shape);
  const std::uint32_t vertex_count = std::uint32_t{1} << 31;
  const std::array<std::uint32_t, 4> planes{vertex_count, 1, 0, vertex_count};
  Bytes stored(ZSTD_compressBound(sizeof(planes)));
  stored.resize(ZSTD_compress(stored.data(), stored.size(), planes.data(), sizeof(planes), 1));
  Bytes file = serialize_map(map, {Compression::zstd});
  const std::size_t block = find_chunk(file, "BLCK");
  file = testing::replace_chunk(file, block, stored);
  put<std::uint64_t>(file, entry_at(block) + testing::kDecodedIn,
                     16 + 4 * 2 + std::uint64_t{vertex_count} * 4);
  testing::repair_checksums(file);

  const testing::AllocationWatch watch;
  const auto faults = check_map(file, {kTerabyte});
  EXPECT_LT(watch.largest(), kSmallAllocation);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].number, 33);
}

TEST(Fault, TinyFileThatClaimsATerabyteAllocatesLittle) {
  // In the header, in the table, in the raw block, and as an image of 2^20 x 2^20 texels.
  Bytes header = sample_file();
  put<std::uint64_t>(header, testing::kFileSizeAt, kTerabyte);
  Bytes decoded = sample_file(Compression::zstd);
  put<std::uint64_t>(decoded, entry_at(find_chunk(decoded, "BLCK")) + testing::kDecodedIn, kTerabyte);
  Bytes block = sample_file();
  put<std::uint32_t>(block, payload_at(block, "BLCK"), 0xFFFFFFFF);
  Bytes image = sample_file();
  put<std::uint32_t>(image, payload_at(image, "MAPD", 32 + 148), 1 << 20);
  put<std::uint32_t>(image, payload_at(image, "MAPD", 32 + 152), 1 << 20);
  const std::array<std::pair<Bytes, int>, 4> files{{{header, 5}, {decoded, 33}, {block, 60}, {image, 46}}};
  for (auto [file, number] : files) {
    testing::repair_checksums(file);
    const testing::AllocationWatch watch;
    const auto faults = check_map(file, {2 * kTerabyte});
    EXPECT_LT(watch.largest(), kSmallAllocation);
    ASSERT_FALSE(faults.empty());
    EXPECT_EQ(faults[0].number, number);
  }
}

TEST(Fault, FilesThatAreNone) {
  const testing::ScratchFolder folder;
  for (const std::filesystem::path& path :
       {folder.path(), folder.path() / "missing", std::filesystem::path("/dev/zero")}) {
    try {
      static_cast<void>(read_map(path));
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::input);
      EXPECT_EQ(std::string(error.what()).substr(0, path.string().size()), path.string());
    }
  }
}

}  // namespace
}  // namespace pdsm
