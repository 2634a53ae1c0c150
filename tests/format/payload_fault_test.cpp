// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "fault_expectation.h"
#include "random_map.h"

/// Faults within the chunks, one test each: the number of FORMAT.md section 8, and where it is seen.
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

/// The sample file with one 32-bit word of the MAPD chunk changed: fault at the chunk.
void expect_map_fault(std::size_t inside, std::uint32_t value, int number) {
  SCOPED_TRACE(inside);
  Bytes file = sample_file();
  put(file, payload_at(file, "MAPD", inside), value);
  expect_fault(file, number, payload_at(file, "MAPD"));
}

TEST(PayloadFault, MapSizes) {
  for (std::size_t count : {0U, 8U}) {
    expect_map_fault(count, 1000, 40);
    expect_map_fault(count, 0xFFFFFFFF, 40);
  }
  expect_map_fault(4, 0xFFFFFFFF, 40);
  const Bytes file = sample_file();
  Bytes longer(file.begin() + static_cast<std::ptrdiff_t>(payload_at(file, "MAPD")),
               file.begin() + static_cast<std::ptrdiff_t>(payload_at(file, "MAPD") + 219));
  const Bytes long_file = testing::replace_chunk(file, 0, longer);
  EXPECT_TRUE(check_map(long_file).empty()) << check_map(long_file)[0].expected;
  longer.push_back(std::byte{0});
  expect_fault(testing::replace_chunk(file, 0, longer), 40, payload_at(file, "MAPD"));
}

TEST(PayloadFault, MapReservedWords) {
  expect_map_fault(32 + 156, 1, 41);
}

TEST(PayloadFault, Codings) {
  expect_map_fault(16, 24, 42);
  expect_map_fault(20, 7, 42);
  expect_map_fault(24, 2, 42);
  expect_map_fault(28, 0, 42);
  expect_map_fault(28, 256, 42);
}

TEST(PayloadFault, Views) {
  expect_map_fault(0, 0, 43);
  expect_map_fault(32 + 144, 2, 43);
  expect_map_fault(32 + 148, 0, 43);
  expect_map_fault(32 + 152, (1 << 20) + 1, 43);
  // The upper half of each double in turn becomes NaN: rotation, translation, window, near, far.
  for (std::size_t number = 0; number < 18; ++number) expect_map_fault(32 + 8 * number + 4, 0x7FF80000, 43);
}

TEST(PayloadFault, Layers) {
  expect_map_fault(12, 2, 44);
  expect_map_fault(32 + 160 + 16, 0xFFFFFFFF, 44);
}

TEST(PayloadFault, Images) {
  expect_map_fault(32 + 160, 1, 45);
  expect_map_fault(32 + 164, 1, 45);
  expect_map_fault(32 + 168, 1, 45);
  expect_map_fault(32 + 168, 32, 45);
  expect_map_fault(32 + 172, 1, 45);
}

TEST(PayloadFault, BlockCounts) {
  Bytes file = sample_file();
  put<std::uint32_t>(file, payload_at(file, "MAPD", 32 + 148), 64);
  expect_fault(file, 46, testing::kChunkCountAt);
}

TEST(PayloadFault, Samples) {
  Bytes file = sample_file();
  const std::size_t at = payload_at(file, "SMPL");
  const std::array<std::pair<std::size_t, std::uint32_t>, 5> words{
      {{4, 0x7FF00000}, {24, 0x3F000000}, {28, 0x7FC00000}, {32, 0xBF800000}, {36, 1}}};
  for (const auto& [inside, value] : words) {
    SCOPED_TRACE(inside);
    Bytes damaged = file;
    put(damaged, at + 40 + inside, value);
    expect_fault(damaged, 50, at);
  }
  expect_fault(testing::replace_chunk(file, 1, Bytes(41)), 50, at);
}

TEST(PayloadFault, Metadata) {
  Bytes file = sample_file();
  const std::size_t at = payload_at(file, "META");
  for (unsigned char letter : {' ', '[', '\0'}) {
    Bytes damaged = file;
    damaged[at] = static_cast<std::byte>(letter);
    expect_fault(damaged, 51, at);
  }
  for (int letter : {0x00, 0x80, 0xC3, 0xFF}) {
    Bytes damaged = file;
    damaged[at + 3] = static_cast<std::byte>(letter);
    expect_fault(damaged, 51, at);
  }
}

TEST(PayloadFault, BlockKeys) {
  const std::size_t blocks = testing::sample_map().images[0].blocks.size();
  const auto with_keys = [](const Bytes& keys) {
    return testing::insert_chunk(sample_file(), 3, "BKEY", 0, keys);
  };
  const Bytes good(40 * blocks);
  EXPECT_EQ(read_map(with_keys(good), "name").block_keys.size(), blocks);
  const std::size_t at = payload_at(with_keys(good), "BKEY");
  for (const std::size_t size : {std::size_t{0}, good.size() - 1, good.size() - 40, good.size() + 40})
    expect_fault(with_keys(Bytes(size)), 52, at);
  for (const auto& [inside, value] : {std::pair<std::size_t, std::uint32_t>{32, 64 * 64 + 1}, {36, 1}}) {
    Bytes bad = good;
    put(bad, inside, value);
    expect_fault(with_keys(bad), 52, at);
  }
}

/// The sample file with its first block replaced by bytes that `change` made of the old ones.
template <typename Change>
void expect_block_fault(int number, Change change) {
  const Bytes file = sample_file();
  const std::size_t index = find_chunk(file, "BLCK"), at = payload_at(file, "BLCK");
  const auto size = get<std::int64_t>(file, entry_at(index) + testing::kStoredIn);
  const auto first = file.begin() + static_cast<std::ptrdiff_t>(at);
  Bytes block(first, first + size);
  change(block);
  expect_fault(testing::replace_chunk(file, index, block), number, at);
}

/// Where the parts of the first block (64 x 2 texels) lie.
constexpr std::size_t kFirstIn = 16, kDomainIn = kFirstIn + 129 * 4, kWordsIn = kDomainIn + 128 * 4;

TEST(PayloadFault, BlockSizes) {
  expect_block_fault(60, [](Bytes& block) { block.resize(15); });
  expect_block_fault(60, [](Bytes& block) { block.resize(block.size() - 4); });
  expect_block_fault(60, [](Bytes& block) { block.resize(block.size() + 1); });
  expect_block_fault(60, [](Bytes& block) { put<std::uint32_t>(block, 0, 0xFFFFFFFF); });
}

TEST(PayloadFault, BlockReservedWords) {
  expect_block_fault(61, [](Bytes& block) { put<std::uint32_t>(block, 4, 3); });
  expect_block_fault(61, [](Bytes& block) { put<std::uint32_t>(block, 8, 1); });
  expect_block_fault(61, [](Bytes& block) { put<std::uint32_t>(block, 12, 1); });
}

TEST(PayloadFault, FunctionOffsets) {
  expect_block_fault(62, [](Bytes& block) { put<std::uint32_t>(block, kFirstIn, 1); });
  expect_block_fault(62, [](Bytes& block) { put<std::uint32_t>(block, kFirstIn + 4, 0xFFFFFFFF); });
  expect_block_fault(60, [](Bytes& block) {
    put<std::uint32_t>(block, kDomainIn - 4, get<std::uint32_t>(block, kDomainIn - 4) + 1);
  });
}

TEST(PayloadFault, VertexDepths) {
  // The second vertex of the first function that has two takes the depth of the first.
  expect_block_fault(63, [](Bytes& block) {
    std::size_t texel = 0;
    while (get<std::uint32_t>(block, kFirstIn + 4 * texel + 4) -
               get<std::uint32_t>(block, kFirstIn + 4 * texel) <
           2)
      ++texel;
    const std::size_t vertex = kWordsIn + 4 * get<std::uint32_t>(block, kFirstIn + 4 * texel);
    put(block, vertex + 4, get<std::uint16_t>(block, vertex));
  });
}

TEST(PayloadFault, LastVertex) {
  expect_block_fault(65, [](Bytes& block) { block.back() ^= std::byte{1}; });
}

TEST(PayloadFault, DomainEnds) {
  expect_block_fault(67, [](Bytes& block) { put<std::uint32_t>(block, kDomainIn + 8, 0x10000); });
}

TEST(PayloadFault, VertexValuesAndUnusedBits) {
  testing::MapShape shape;
  shape.coding = {32, 8, 100};
  shape.empty_share = 0;
  const PenumbraMap map = testing::random_map(23, shape);
  const Bytes file = serialize_map(map, {Compression::none});
  const std::size_t words = payload_at(file, "BLCK", 16 + (7 * 13 + 1) * 4 + 7 * 13 * 4);
  Bytes value = file;
  put<std::uint8_t>(value, words + 4, 101);
  expect_fault(value, 64, payload_at(file, "BLCK"));
  Bytes bits = file;
  put<std::uint8_t>(bits, words + 7, 0x80);
  expect_fault(bits, 66, payload_at(file, "BLCK"));
}

}  // namespace
}  // namespace pdsm
