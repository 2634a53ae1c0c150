// SPDX-License-Identifier: Apache-2.0
// Pictures of lights: OpenEXR in linear light, others in sRGB; the top row is at +y.
#include <ImfChannelList.h>
#include <ImfRgbaFile.h>
#include <gtest/gtest.h>

#include <fstream>

#include "scene_folder.h"
#include "test_pictures.h"

namespace pdsm::test {
namespace {

constexpr const char* kScene =
    R"({"lights": [{"type": "rect", "width": 1, "height": 1, "position": [0,5,0], "direction": [0,-1,0],
        "emission": "a.picture"}]})";

class EmissionImport : public testing::Test {
 protected:
  EmissionImage read(const std::string& bytes) {
    folder_.write("a.picture", bytes);
    return *folder_.read(kScene).lights.at(0).emission;
  }
  std::string fault(const std::string& bytes) {
    folder_.write("a.picture", bytes);
    return folder_.fault_of(kScene);
  }
  /// A picture whose window does not begin at 0.
  void write_exr(int width, int height, const std::vector<Imf::Rgba>& pixels) {
    const Imath::Box2i window({-3, 7}, {width - 4, height + 6});
    Imf::RgbaOutputFile file((folder_.path() / "a.picture").c_str(), window, window, Imf::WRITE_RGB);
    file.setFrameBuffer(pixels.data() + 3 - 7 * width, 1, static_cast<std::size_t>(width));
    file.writePixels(height);
  }

  SceneFolder folder_;
};

TEST_F(EmissionImport, SrgbByLuminanceFromTheTop) {
  const EmissionImage image = read(png(2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 188, 188, 188}));
  ASSERT_EQ(image.width, 2U);
  ASSERT_EQ(image.height, 2U);
  // The lower row comes first; 188 is half as bright as 255: ((188 / 255 + .055) / 1.055)^2.4 = .5029.
  EXPECT_FLOAT_EQ(image.luminance[0], 0.0722F);
  EXPECT_NEAR(image.luminance[1], 0.5029, 1e-4);
  EXPECT_FLOAT_EQ(image.luminance[2], 0.2126F);
  EXPECT_FLOAT_EQ(image.luminance[3], 0.7152F);
  EXPECT_EQ(image.colour[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(image.colour[3], glm::vec3(0, 1, 0));
}

TEST_F(EmissionImport, DarkSrgbIsLinear) {
  EXPECT_FLOAT_EQ(read(grey_tga(2, 1, {10, 255})).luminance[0], 10 / 255.0F / 12.92F);
}

TEST_F(EmissionImport, OpenExrIsLinearAndMayBeBright) {
  write_exr(3, 2, {{100, 100, 100}, {0, 1, 0}, {2, 0, 0}, {0, 0, 0}, {0, 0, 0.5F}, {1, 1, 1}});
  const EmissionImage image = *folder_.read(kScene).lights.at(0).emission;
  ASSERT_EQ(image.width, 3U);
  ASSERT_EQ(image.height, 2U);
  const std::vector<float> expected{0, 0.0361F, 1, 100, 0.7152F, 0.4252F};
  for (std::size_t n = 0; n < 6; ++n) EXPECT_FLOAT_EQ(image.luminance[n], expected[n]) << n;
}

TEST_F(EmissionImport, ItsBytesCount) {
  folder_.write("a.picture", grey_jpeg(100));
  const Scene a = folder_.read(kScene);
  folder_.write("a.picture", grey_jpeg(101));
  EXPECT_NE(folder_.read(kScene).content_hash, a.content_hash);
  ASSERT_EQ(a.files.size(), 2U);
  EXPECT_EQ(a.files[1], folder_.path() / "a.picture");
}

TEST_F(EmissionImport, FaultsNameTheField) {
  const std::string field = "level.scene.json:lights[0].emission: ";
  EXPECT_EQ(folder_.fault_of(kScene), field + "a.picture: no such file");
  EXPECT_EQ(fault("hello").find(field + "a.picture: is not a PNG, JPEG or TGA picture"), 0U)
      << fault("hello");
  EXPECT_EQ(fault("\x76\x2f\x31\x01hello").find(field + "a.picture: is not an OpenEXR picture"), 0U);
  EXPECT_EQ(fault(grey_jpeg(0)), field + "a.picture: is black");
  write_exr(1, 1, {{-1, -1, -1}});
  EXPECT_EQ(folder_.fault_of(kScene), field + "a.picture: must be finite and not negative");
  EXPECT_EQ(folder_.fault_of(R"({"lights": [{"type": "rect", "width": 1, "height": 1, "position": [0,5,0],
      "direction": [0,-1,0], "emission": ""}]})"),
            field + "must name a file");
}

TEST_F(EmissionImport, OfEveryPrefix) {
  write_exr(3, 2, std::vector<Imf::Rgba>(6, Imf::Rgba(1, 1, 1)));
  std::ifstream file(folder_.path() / "a.picture", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  ASSERT_GT(whole.size(), 100U);
  for (std::size_t size = 0; size < whole.size(); size += 7)
    EXPECT_NE(fault(whole.substr(0, size)), "") << size;
}

}  // namespace
}  // namespace pdsm::test
