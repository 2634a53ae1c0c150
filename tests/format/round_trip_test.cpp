// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "file_bytes.h"
#include "pdsm/format/map_file.h"
#include "random_map.h"
#include "scratch_folder.h"

namespace pdsm {
namespace {

using testing::all_codings;
using testing::MapShape;
using testing::random_map;
using testing::random_shape;

constexpr WriteOptions kRaw{Compression::none};
constexpr WriteOptions kZstd{Compression::zstd};

/// Written, checked, read, compared, and written once more.
void expect_round_trip(const PenumbraMap& map) {
  ASSERT_EQ(find_invariant_fault(map), "");
  for (const WriteOptions& options : {kRaw, kZstd}) {
    const auto bytes = serialize_map(map, options);
    ASSERT_TRUE(check_map(bytes).empty()) << check_map(bytes).front().expected;
    const PenumbraMap read = read_map(bytes, "memory");
    EXPECT_EQ(read, map);
    EXPECT_EQ(serialize_map(read, options), bytes);
  }
}

TEST(RoundTrip, EveryCodingWithAndWithoutDomainEnds) {
  std::uint64_t seed = 100;
  for (const VertexCoding& coding : all_codings()) {
    for (bool domain_end : {false, true}) {
      SCOPED_TRACE(testing::name_of(coding));
      MapShape shape;
      shape.coding = coding;
      shape.domain_end = domain_end;
      expect_round_trip(random_map(++seed, shape));
    }
  }
}

TEST(RoundTrip, ImageSizesWithCutBlocks) {
  const std::array<std::array<std::uint32_t, 2>, 7> sizes{
      {{1, 1}, {1, 200}, {200, 1}, {7, 13}, {64, 64}, {65, 130}, {130, 65}}};
  for (const auto& [width, height] : sizes) {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    MapShape shape;
    shape.width = width;
    shape.height = height;
    expect_round_trip(random_map(width * 1000 + height, shape));
  }
}

TEST(RoundTrip, AllFunctionsEmpty) {
  MapShape shape;
  shape.width = shape.height = 70;
  shape.empty_share = 1;
  expect_round_trip(random_map(1, shape));
}

TEST(RoundTrip, FunctionsOfTenThousandVertices) {
  for (std::uint32_t depth_bits : {16U, 32U}) {
    MapShape shape;
    shape.coding = {depth_bits, 16, 65535};
    shape.width = shape.height = 2;
    PenumbraMap map = random_map(2, shape);
    testing::Random random(3);
    std::vector<std::vector<FunctionVertex>> functions(4);
    for (std::size_t texel : {0U, 2U, 3U}) {
      auto& function = functions[texel];
      for (std::uint32_t n = 0; n < 10000; ++n)
        function.push_back({n * 6 + static_cast<std::uint32_t>(random.below(6)), n, 65535 - n});
      function.back().end = function.back().begin;
    }
    auto& block = map.images[0].blocks[0];
    const auto domain_end = block.domain_end;
    block = testing::make_block(shape.coding, functions);
    block.domain_end = domain_end;
    expect_round_trip(map);
  }
}

TEST(RoundTrip, SeveralViewsLayersAndLevels) {
  MapShape shape;
  shape.width = 70;
  shape.height = 9;
  shape.views = 3;
  shape.layers = 2;
  shape.levels = 7;
  shape.projection = Projection::orthographic;
  expect_round_trip(random_map(4, shape));
}

TEST(RoundTrip, ThreeChannels) {
  MapShape shape;
  shape.width = 130;
  shape.height = 70;
  shape.views = shape.layers = shape.levels = 2;
  shape.channels = 3;
  expect_round_trip(random_map(5, shape));
}

TEST(RoundTrip, ChannelsThatAreEqualAreStoredOnce) {
  MapShape shape;
  shape.width = shape.height = 100;
  shape.levels = 2;
  const PenumbraMap grey = random_map(6, shape);
  PenumbraMap map = grey;
  map.channels = 3;
  for (std::uint32_t channel : {1U, 2U}) {
    for (FunctionImage image : grey.images) {
      image.channel = channel;
      map.images.push_back(std::move(image));
    }
  }
  expect_round_trip(map);
  // Only entries are added: of two channels, two levels, four blocks and one, and what describes four images.
  const std::size_t added = serialize_map(map).size() - serialize_map(grey).size();
  EXPECT_LE(added, 2 * 5 * 56 + 4 * 16 + 2 * 16U);
}

TEST(RoundTrip, DomainEndsOfSomeBlocksOnly) {
  MapShape shape;
  shape.width = 70;
  PenumbraMap map = random_map(5, shape);
  map.images[0].blocks[1].domain_end.clear();
  expect_round_trip(map);
}

TEST(RoundTrip, ExtremeNumbers) {
  MapShape shape;
  shape.projection = Projection::orthographic;
  PenumbraMap map = random_map(6, shape);
  map.views[0].near_depth = -0x1p60;
  map.views[0].far_depth = 0x1p-1074;
  map.views[0].window = {-0.0, 0x1p-1074, 0x1p900, 1};
  map.samples = {{{-0.0, 1e300, 5e-324}, {-0.5F, 0x1p-149F}, 0}};
  expect_round_trip(map);
  const PenumbraMap read = read_map(serialize_map(map), "memory");
  EXPECT_TRUE(std::signbit(read.views[0].window[0]));
  EXPECT_TRUE(std::signbit(read.samples[0].position[0]));
}

TEST(RoundTrip, AnyValidMap) {
  EXPECT_TRUE(rc::check("read(write(map)) = map", [](std::uint64_t seed) {
    const PenumbraMap map = random_map(seed, random_shape(seed));
    for (const WriteOptions& options : {kRaw, kZstd}) {
      const auto bytes = serialize_map(map, options);
      const PenumbraMap read = read_map(bytes, "memory");
      RC_ASSERT(read == map);
      RC_ASSERT(serialize_map(read, options) == bytes);
    }
  }));
}

TEST(RoundTrip, FileHoldsWhatSerializeGives) {
  const testing::ScratchFolder folder;
  const auto path = folder.path() / "light \xC3\xA9.pdsm";
  const PenumbraMap map = random_map(7, random_shape(7));
  const std::uint64_t size = write_map(map, path);
  EXPECT_EQ(testing::file_content(path), serialize_map(map));
  EXPECT_EQ(size, std::filesystem::file_size(path));
  EXPECT_EQ(read_map(path), map);
  EXPECT_EQ(folder.names().size(), 1U);
}

/// The writer's buffer holds a megabyte.
TEST(RoundTrip, FileOfSeveralMegabytes) {
  const testing::ScratchFolder folder;
  MapShape shape;
  shape.coding = {32, 32, 255};
  shape.width = shape.height = 200;
  shape.empty_share = 0;
  const PenumbraMap map = random_map(11, shape);
  const std::uint64_t size = write_map(map, folder.path() / "map", kRaw);
  EXPECT_GT(size, std::uint64_t{2} << 20);
  EXPECT_EQ(testing::file_content(folder.path() / "map"), serialize_map(map, kRaw));
}

TEST(RoundTrip, EncodedBlocksGiveTheSameFile) {
  const testing::ScratchFolder folder;
  MapShape shape;
  shape.width = 130;
  shape.levels = 2;
  PenumbraMap map = random_map(8, shape);
  for (const WriteOptions& options : {kRaw, kZstd}) {
    std::vector<std::vector<EncodedBlock>> blocks;
    PenumbraMap shell = map;
    for (FunctionImage& image : shell.images) {
      auto& encoded = blocks.emplace_back();
      for (std::uint32_t b = 0; b < image.blocks.size(); ++b) {
        const auto extent =
            block_extent(image.width, image.height, b % image.blocks_across(), b / image.blocks_across());
        encoded.push_back(encode_block(map.coding, extent[0], extent[1], image.blocks[b], options));
      }
      image.blocks.clear();
    }
    write_encoded_map(shell, blocks, folder.path() / "map");
    EXPECT_EQ(testing::file_content(folder.path() / "map"), serialize_map(map, options));
  }
}

TEST(RoundTrip, RawBlocksLieAlignedAsTheyAreInMemory) {
  MapShape shape;
  shape.width = 70;
  const PenumbraMap map = random_map(9, shape);
  const testing::Bytes bytes = serialize_map(map, kRaw);
  const std::size_t first_block = testing::find_chunk(bytes, "BLCK");
  for (std::size_t n = 0; n < map.images[0].blocks.size(); ++n) {
    const FunctionBlock& block = map.images[0].blocks[n];
    auto at = testing::get<std::uint64_t>(bytes, testing::entry_at(first_block + n) + testing::kOffsetIn);
    EXPECT_EQ(at % 16, 0U);
    const auto expect_array = [&](const std::vector<std::uint32_t>& values) {
      for (std::uint32_t value : values) {
        EXPECT_EQ(testing::get<std::uint32_t>(bytes, at), value);
        at += 4;
      }
    };
    EXPECT_EQ(testing::get<std::uint32_t>(bytes, at), block.first.back());
    EXPECT_EQ(testing::get<std::uint32_t>(bytes, at + 4), 1U);
    at += 16;
    expect_array(block.first);
    expect_array(block.domain_end);
    expect_array(block.words);
  }
}

TEST(RoundTrip, NeighbouringFunctionsCompress) {
  // A smooth penumbra: depths and values drift from texel to texel.
  const VertexCoding coding;
  std::vector<std::vector<FunctionVertex>> functions(kBlockSize * kBlockSize);
  for (std::uint32_t texel = 0; texel < functions.size(); ++texel) {
    const std::uint32_t x = texel % kBlockSize, y = texel / kBlockSize;
    functions[texel] = {
        {20000 + 5 * x + 3 * y, 0, 40 + x}, {26000 + 2 * x + 7 * y, 40 + x, 255}, {31000 + x + y, 255, 255}};
  }
  const FunctionBlock block = testing::make_block(coding, functions);
  const EncodedBlock encoded = encode_block(coding, kBlockSize, kBlockSize, block);
  EXPECT_LT(encoded.bytes.size(), block.words.size() * 4 / 20);
  EXPECT_EQ(encoded.decoded_bytes, encode_block(coding, kBlockSize, kBlockSize, block, kRaw).bytes.size());
}

TEST(RoundTrip, ListsChunks) {
  MapShape shape;
  shape.width = 70;
  const PenumbraMap map = random_map(10, shape);
  const auto chunks = list_chunks(serialize_map(map, kRaw));
  std::vector<std::string> types;
  for (const ChunkSummary& chunk : chunks) {
    types.push_back(chunk.type);
    EXPECT_EQ(chunk.stored_bytes, chunk.decoded_bytes);
  }
  EXPECT_EQ(types, (std::vector<std::string>{"MAPD", "SMPL", "META", "BLCK", "BLCK"}));
  EXPECT_EQ(chunks[2].stored_bytes, map.metadata.size());
}

TEST(RoundTrip, ListsTheImagesOfBlocks) {
  MapShape shape;
  shape.width = 70;
  shape.levels = 3;
  std::vector<std::uint32_t> images;
  for (const ChunkSummary& chunk : list_chunks(serialize_map(random_map(12, shape), kRaw))) {
    if (chunk.type == "BLCK") images.push_back(chunk.image);
  }
  EXPECT_EQ(images, (std::vector<std::uint32_t>{0, 0, 1, 2}));
}

}  // namespace
}  // namespace pdsm
