// SPDX-License-Identifier: Apache-2.0
#include "pdsm/format/deep_exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstring>

#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "random_map.h"
#include "scratch_folder.h"

namespace pdsm {
namespace {

using testing::MapShape;
using testing::random_map;
using testing::ScratchFolder;

TEST(DeepExr, RoundTripOfEveryCoding) {
  const ScratchFolder folder;
  std::uint64_t seed = 40;
  for (const VertexCoding& coding : testing::all_codings()) {
    for (bool domain_end : {false, true}) {
      MapShape shape;
      shape.coding = coding;
      shape.domain_end = domain_end;
      const PenumbraMap map = random_map(++seed, shape);
      export_deep_exr(map, folder.path() / "deep.exr");
      EXPECT_EQ(import_deep_exr(folder.path() / "deep.exr"), map) << testing::name_of(coding);
    }
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"deep.exr"});
}

TEST(DeepExr, RoundTripOfAnyValidMap) {
  const ScratchFolder folder;
  EXPECT_TRUE(rc::check("import(export(map)) = map", [&](std::uint64_t seed) {
    const PenumbraMap map = random_map(seed, testing::random_shape(seed));
    export_deep_exr(map, folder.path() / "deep.exr");
    RC_ASSERT(import_deep_exr(folder.path() / "deep.exr") == map);
  }));
}

TEST(DeepExr, RoundTripOfBlocksWithAndWithoutDomainEnds) {
  const ScratchFolder folder;
  MapShape shape;
  shape.width = 130;
  PenumbraMap map = random_map(41, shape);
  map.images[0].blocks[1].domain_end.clear();
  export_deep_exr(map, folder.path() / "deep.exr");
  EXPECT_EQ(import_deep_exr(folder.path() / "deep.exr"), map);
}

/// Depths as a viewer sees them: channel Z, the file's first row uppermost.
TEST(DeepExr, OtherToolsSeeDepthsAndAlpha) {
  const ScratchFolder folder;
  const auto path = folder.path() / "deep.exr";
  MapShape shape;
  shape.width = 1;
  shape.height = 2;
  PenumbraMap map = random_map(42, shape);
  const std::vector<FunctionVertex> function{{100, 51, 51}, {200, 255, 255}};
  map.images[0].blocks[0].first = {0, 2, 2};
  map.images[0].blocks[0].words = testing::make_block(map.coding, {function}).words;
  export_deep_exr(map, path);

  Imf::MultiPartInputFile file(path.c_str());
  Imf::DeepScanLineInputPart part(file, 0);
  std::array<std::uint32_t, 2> counts{};
  std::array<float, 2> depth{}, alpha{};
  float *depth_pointer = depth.data(), *alpha_pointer = alpha.data();
  Imf::DeepFrameBuffer buffer;
  buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 4));
  buffer.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(&depth_pointer), 8, 0, 4));
  buffer.insert("A", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(&alpha_pointer), 8, 0, 4));
  part.setFrameBuffer(buffer);
  part.readPixelSampleCounts(0, 1);
  EXPECT_EQ(counts, (std::array<std::uint32_t, 2>{0, 2}));
  part.readPixels(1);
  EXPECT_FLOAT_EQ(depth[0], static_cast<float>(decode_depth(map.views[0], map.coding, 100)));
  EXPECT_FLOAT_EQ(depth[1], static_cast<float>(decode_depth(map.views[0], map.coding, 200)));
  EXPECT_EQ(alpha, (std::array<float, 2>{0.2F, 1}));
}

/// Input error that names the file, or a valid map.
void expect_refused_or_valid(const std::filesystem::path& path) {
  try {
    EXPECT_EQ(find_invariant_fault(import_deep_exr(path)), "");
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::input) << error.what();
    const std::string message = error.what();
    EXPECT_EQ(message.substr(0, path.string().size()), path.string());
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

std::vector<std::byte> small_exr(const std::filesystem::path& folder) {
  MapShape shape;
  shape.width = 3;
  shape.height = 2;
  shape.samples = 1;
  export_deep_exr(random_map(43, shape), folder / "good.exr");
  return testing::file_content(folder / "good.exr");
}

TEST(DeepExr, EveryTruncationIsRefused) {
  const ScratchFolder folder;
  const auto bytes = small_exr(folder.path());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    testing::put_file(folder.path() / "cut.exr", std::span(bytes).first(size));
    EXPECT_THROW(static_cast<void>(import_deep_exr(folder.path() / "cut.exr")), Error) << size;
  }
}

TEST(DeepExr, ABitFlipInEveryByteIsRefusedOrValid) {
  const ScratchFolder folder;
  auto bytes = small_exr(folder.path());
  const auto path = folder.path() / "flipped.exr";
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    const auto flip = static_cast<std::byte>(1 << n % 8);
    bytes[n] ^= flip;
    testing::put_file(path, bytes);
    expect_refused_or_valid(path);
    bytes[n] ^= flip;
  }
}

TEST(DeepExr, RandomDamageIsRefusedOrValid) {
  const ScratchFolder folder;
  const auto bytes = small_exr(folder.path());
  const auto path = folder.path() / "damaged.exr";
  testing::Random random(44);
  for (int round = 0; round < 2000; ++round) {
    auto damaged = bytes;
    const double share = random.chance(0.5) ? 0.1 : 0.002;
    for (std::byte& byte : damaged)
      if (random.chance(share)) byte = static_cast<std::byte>(random.below(256));
    testing::put_file(path, damaged);
    expect_refused_or_valid(path);
  }
}

TEST(DeepExr, RefusesWhatIsNoExport) {
  const ScratchFolder folder;
  const auto path = folder.path() / "x.exr";
  for (const std::string content : {"", "v/1\x01", "text that is no image at all"}) {
    testing::put_file(path, std::as_bytes(std::span(content)));
    EXPECT_THROW(static_cast<void>(import_deep_exr(path)), Error);
  }
  EXPECT_THROW(static_cast<void>(import_deep_exr(folder.path())), Error);
  EXPECT_THROW(static_cast<void>(import_deep_exr(folder.path() / "missing")), Error);
}

/// Where the attribute begins whose name and type, each with its zero, are `name_and_type`.
std::vector<std::byte>::iterator find_attribute(std::vector<std::byte>& bytes,
                                                const std::string& name_and_type) {
  return std::search(bytes.begin(), bytes.end(), name_and_type.begin(), name_and_type.end(),
                     [](std::byte a, char b) { return a == static_cast<std::byte>(b); });
}

/// Expects a file whose attribute states another size to be refused before OpenEXR reads it.
void expect_size_refused(const std::string& name_and_type, std::uint32_t size) {
  SCOPED_TRACE(name_and_type);
  const ScratchFolder folder;
  auto bytes = small_exr(folder.path());
  const auto found = find_attribute(bytes, name_and_type);
  ASSERT_NE(found, bytes.end());
  std::memcpy(&*found + name_and_type.size(), &size, sizeof(size));
  testing::put_file(folder.path() / "size.exr", bytes);
  try {
    static_cast<void>(import_deep_exr(folder.path() / "size.exr"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("an attribute ends behind the file"), std::string::npos);
  }
}

/// An attribute that claims 2 GB is refused before anybody allocates it.
TEST(DeepExr, AttributeSizesAreHeldAgainstTheFile) {
  expect_size_refused(std::string("pdsmMap\0string\0", 15), 0x7FFFFFF0);
}

/// OpenEXR reads these by their types, whatever size they state, and what follows then from elsewhere.
TEST(DeepExr, AttributeSizesAreHeldAgainstTheirTypes) {
  expect_size_refused(std::string("channels\0chlist\0", 16), 20);
  expect_size_refused(std::string("channels\0chlist\0", 16), 200);
  expect_size_refused(std::string("dataWindow\0box2i\0", 17), 12);
  expect_size_refused(std::string("lineOrder\0lineOrder\0", 20), 2);
}

/// A channel's name as OpenEXR quotes it; it is followed by the channel's type, which is made an unknown one.
TEST(DeepExr, NamesOfTheFileDoNotBreakTheMessage) {
  const ScratchFolder folder;
  auto bytes = small_exr(folder.path());
  const auto found = find_attribute(bytes, std::string("pdsm.depth\0", 11));
  ASSERT_NE(found, bytes.end());
  *(found + 4) = static_cast<std::byte>('\r');
  *(found + 11) = std::byte{77};
  testing::put_file(folder.path() / "name.exr", bytes);
  try {
    static_cast<void>(import_deep_exr(folder.path() / "name.exr"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("pdsm depth"), std::string::npos) << error.what();
  }
}

TEST(DeepExr, FailedExportLeavesTheOldFile) {
  const ScratchFolder folder;
  const auto path = folder.path() / "deep.exr";
  testing::put_file(path, std::as_bytes(std::span("old", 3)));
  const PenumbraMap map = random_map(45);
  EXPECT_THROW(export_deep_exr(map, folder.path()), Error);
  EXPECT_THROW(export_deep_exr(map, path / "x.exr"), Error);
  EXPECT_EQ(testing::file_content(path).size(), 3U);
  EXPECT_EQ(folder.names().size(), 1U);
}

}  // namespace
}  // namespace pdsm
