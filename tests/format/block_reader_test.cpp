// SPDX-License-Identifier: Apache-2.0
// Blocks of files that are sound in part.
#include "pdsm/format/block_reader.h"

#include <gtest/gtest.h>

#include "file_bytes.h"
#include "random_map.h"
#include "scratch_folder.h"

namespace pdsm {
namespace {

using testing::Bytes;

class BlockReaderTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "map"; }
  [[nodiscard]] std::optional<BlockReader> open(const Bytes& bytes) const {
    testing::put_file(file(), bytes);
    return BlockReader::open(file());
  }
  testing::ScratchFolder folder_;
};

PenumbraMap map_of(std::uint64_t seed) {
  testing::MapShape shape;
  shape.width = 140;
  shape.height = 70;
  shape.levels = 2;
  shape.block_keys = true;
  return testing::random_map(seed, shape);
}

/// How many blocks are there; those are the map's.
std::size_t count_read(const BlockReader& reader, const PenumbraMap& map) {
  std::size_t count = 0;
  for (std::uint32_t n = 0; n < map.images.size(); ++n) {
    for (std::uint32_t b = 0; b < map.images[n].blocks.size(); ++b) {
      const auto block = reader.read(n, b);
      if (!block) continue;
      ++count;
      EXPECT_EQ(*block, map.images[n].blocks[b]);
    }
  }
  return count;
}

TEST_F(BlockReaderTest, ReadsAllOfAGoodFile) {
  for (const Compression compression : {Compression::none, Compression::zstd}) {
    const PenumbraMap map = map_of(31);
    const auto reader = open(serialize_map(map, {compression}));
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->frame().block_keys, map.block_keys);
    EXPECT_EQ(reader->frame().images.size(), 2U);
    EXPECT_EQ(count_read(*reader, map), 6U + 2U);
  }
}

TEST_F(BlockReaderTest, LeavesOutWhatIsDamaged) {
  const PenumbraMap map = map_of(32);
  const Bytes good = serialize_map(map);
  const std::size_t first = testing::find_chunk(good, "BLCK");
  for (std::size_t lost = 1; lost <= 8; ++lost) {
    Bytes bytes = good;
    for (std::size_t n = 0; n < lost; ++n)
      bytes[testing::get<std::uint64_t>(good, testing::entry_at(first + n) + testing::kOffsetIn)] ^=
          std::byte{4};
    const auto reader = open(bytes);
    ASSERT_TRUE(reader);
    EXPECT_EQ(count_read(*reader, map), 8 - lost);
  }
  // Without its keys, and without samples and metadata.
  for (const char* type : {"BKEY", "SMPL", "META"}) {
    Bytes bytes = good;
    const std::size_t entry = testing::entry_at(testing::find_chunk(good, type));
    bytes[testing::get<std::uint64_t>(good, entry + testing::kOffsetIn)] ^= std::byte{4};
    const auto reader = open(bytes);
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->frame().block_keys.empty(), type == std::string("BKEY"));
    EXPECT_EQ(count_read(*reader, map), 8U);
  }
}

TEST_F(BlockReaderTest, RefusesWhatIsNoMap) {
  const Bytes good = serialize_map(map_of(33));
  for (std::size_t size = 0; size < good.size(); size += 1 + good.size() / 50)
    EXPECT_FALSE(open(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)))) << size;
  Bytes bytes = good;
  bytes[testing::get<std::uint64_t>(good, testing::entry_at(0) + testing::kOffsetIn)] ^= std::byte{4};
  EXPECT_FALSE(open(bytes)) << "MAPD";
  EXPECT_FALSE(BlockReader::open(folder_.path() / "none"));
  EXPECT_FALSE(BlockReader::open(folder_.path()));
}

TEST_F(BlockReaderTest, HoldsTheLimits) {
  const PenumbraMap map = map_of(34);
  testing::put_file(file(), serialize_map(map));
  EXPECT_FALSE(BlockReader::open(file(), {64})) << "not even MAPD is within them";
  const auto reader = BlockReader::open(file(), {4096});
  ASSERT_TRUE(reader);
  EXPECT_FALSE(reader->read(0, 0)) << "4096 texels take more";
}

/// No bit that is flipped makes it tell other functions.
TEST_F(BlockReaderTest, NeverTellsWhatIsNotThere) {
  const PenumbraMap map = map_of(35);
  const Bytes good = serialize_map(map);
  testing::Random random(3);
  for (int n = 0; n < 300; ++n) {
    Bytes bytes = good;
    bytes[random.below(bytes.size())] ^= static_cast<std::byte>(1 << n % 8);
    const auto reader = open(bytes);
    EXPECT_LE(reader ? count_read(*reader, map) : 0, 8U);
  }
}

}  // namespace
}  // namespace pdsm
