// SPDX-License-Identifier: Apache-2.0
// Hair files, and the `curves` of scene files.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "scene_folder.h"

namespace pdsm::test {
namespace {

/// A hair file under construction, of two strands with one and two segments.
struct HairFile {
  std::uint32_t strands = 2, points = 5, arrays = 1 | 2 | 4, segments = 0;
  float thickness = 0.5F;
  std::vector<std::uint16_t> lengths{1, 2};
  std::vector<float> places{0, 0, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0, 2, 2, 0};
  std::vector<float> widths{0.2F, 0.2F, 0.4F, 0.4F, 0.4F};
  std::string tail;

  [[nodiscard]] std::string bytes() const {
    std::string text(128, '\0');
    std::memcpy(text.data(), "HAIR", 4);
    const std::array<std::uint32_t, 4> counts{strands, points, arrays, segments};
    std::memcpy(text.data() + 4, counts.data(), sizeof counts);
    std::memcpy(text.data() + 20, &thickness, sizeof thickness);
    const auto append = [&](const auto& values) {
      text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
    };
    append(lengths);
    append(places);
    append(widths);
    return text + tail;
  }
};

class HairImport : public testing::Test {
 protected:
  static std::string scene_text(const std::string& extra = "") {
    return R"({"curves": [{"file": "a.hair")" + extra + "}]}";
  }
  Scene read(const HairFile& file, const std::string& extra = "") {
    folder_.write("a.hair", file.bytes());
    return folder_.read(scene_text(extra));
  }
  std::string fault(const std::string& bytes, const std::string& extra = "") {
    folder_.write("a.hair", bytes);
    return folder_.fault_of(scene_text(extra));
  }

  SceneFolder folder_;
};

TEST_F(HairImport, StrandsWithTheirWidths) {
  const Scene scene = read({}, R"(, "shape": "flat", "scale": 2, "translate": [1,0,0])");
  ASSERT_EQ(scene.curves.size(), 1U);
  const Curves& curves = scene.curves[0];
  EXPECT_EQ(curves.name, "a.hair");
  EXPECT_EQ(curves.shape, CurveShape::flat);
  EXPECT_EQ(curves.strands->segments, (std::vector<std::uint32_t>{0, 2, 3}));
  ASSERT_EQ(curves.strands->points.size(), 5U);
  EXPECT_EQ(curves.strands->points[1], glm::vec4(0, 1, 0, 0.1F));
  EXPECT_EQ(curves.strands->points[4], glm::vec4(2, 2, 0, 0.2F));
  EXPECT_EQ(length_scale(curves.local_to_world), 2);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(read({}).curves[0].shape, CurveShape::round);
  EXPECT_FALSE(read({}, R"(, "casts": false)").curves[0].casts);
}

TEST_F(HairImport, TakesTheHeadersDefaults) {
  HairFile file;
  file.arrays = 2;
  file.lengths.clear();
  file.widths.clear();
  file.strands = 1;
  file.segments = 4;
  const Scene scene = read(file);
  EXPECT_EQ(scene.curves[0].strands->segments, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(scene.curves[0].strands->points[3].w, 0.25F);
  // Transparency and colour are passed over.
  file.arrays = 2 | 8 | 16;
  file.tail = std::string(5 * 16, 'x');
  EXPECT_EQ(read(file).curves[0].strands->segments.size(), 4U);
}

TEST_F(HairImport, LeavesOutWhatIsNoSegment) {
  HairFile file;
  file.places[4] = std::numeric_limits<float>::quiet_NaN();
  file.widths[4] = 0;
  const Scene scene = read(file);
  ASSERT_EQ(scene.curves.size(), 1U);
  EXPECT_EQ(scene.curves[0].strands->segments.size(), 1U);
  EXPECT_EQ(scene.warnings,
            (std::vector<std::string>{"a.hair: 2 segments without finite ends or without width left out"}));
  file.widths = {0, 0, 0, -1, 0};
  const Scene none = read(file);
  EXPECT_TRUE(none.curves.empty());
  EXPECT_EQ(none.warnings.back(), "a.hair: is empty, and casts nothing");
}

TEST_F(HairImport, FilesThatAreNoHair) {
  const auto changed = [](auto&& change) {
    HairFile file;
    change(file);
    return file.bytes();
  };
  const auto expect = [&](const std::string& bytes, const std::string& reason) {
    const std::string told = fault(bytes);
    EXPECT_NE(told.find("curves[0].file: "), std::string::npos) << told;
    EXPECT_NE(told.find(reason), std::string::npos) << told;
  };
  const std::string good = HairFile{}.bytes();
  expect("HAIR", "is no hair file: it ends within its header");
  expect("XAIR" + good.substr(4), "is no hair file");
  for (const std::size_t size : {std::size_t{128}, good.size() - 1})
    expect(good.substr(0, size), "does not have as many bytes as its header says");
  expect(good + "x", "does not have as many bytes as its header says");
  expect(changed([](HairFile& file) { file.arrays = 1 | 4; }), "has no points");
  expect(changed([](HairFile& file) { file.arrays |= 64; }), "has arrays that are not known");
  const std::string other = "has strands that do not have as many points as there are";
  expect(changed([](HairFile& file) { file.lengths = {1, 1}; }), other);
  expect(changed([](HairFile& file) { file.lengths = {65535, 65535}; }), other);
  expect(changed([](HairFile& file) {
           file.arrays = 2 | 4;
           file.lengths.clear();
           file.strands = 0xFFFFFFFF;
           file.segments = 0xFFFFFFFF;
         }),
         other);
  EXPECT_NE(folder_.fault_of(R"({"curves": [{"file": "none.hair"}]})").find("no such file"),
            std::string::npos);
}

TEST_F(HairImport, EntriesThatCannotBe) {
  const std::string good = HairFile{}.bytes();
  const auto expect = [&](const std::string& extra, const std::string& reason) {
    const std::string told = fault(good, extra);
    EXPECT_NE(told.find("curves[0]" + reason), std::string::npos) << told;
  };
  expect(R"(, "shape": "square")", ".shape: must be \"round\" or \"flat\"");
  expect(R"(, "scale": [1,1,2])", ".scale: must be one factor for all axes");
  expect(R"(, "receives": true)", ".receives: unknown key");
}

}  // namespace
}  // namespace pdsm::test
