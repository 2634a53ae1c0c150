// SPDX-License-Identifier: Apache-2.0
#include "scene/emission_image.h"

#include <ImfArray.h>
#include <ImfRgbaFile.h>
#include <ImfStdIO.h>

#include <array>
#include <cmath>

#include "pdsm/format/error.h"
#include "scene/format_fault.h"
#include "scene/picture.h"
#include "scene/srgb.h"

namespace pdsm {
namespace {

constexpr std::array<unsigned char, 4> kExrMagic{0x76, 0x2f, 0x31, 0x01};

/// Of linear Rec. 709 colour.
float luminance(float red, float green, float blue) {
  return 0.2126F * red + 0.7152F * green + 0.0722F * blue;
}

float linear(std::uint8_t srgb) {
  return static_cast<float>(srgb_to_linear(srgb / 255.0));
}

EmissionImage make_image(std::uint32_t width, std::uint32_t height) {
  if (width > kMostEmissionTexels || height > kMostEmissionTexels)
    throw FormatFault("has more than " + std::to_string(kMostEmissionTexels) + " texels along an axis");
  const std::size_t texels = std::size_t{width} * height;
  return {width, height, std::vector<float>(texels), std::vector<glm::vec3>(texels)};
}

/// Gives a colour to the texel of row `j` from the top.
void set_texel(EmissionImage& image, std::uint32_t i, std::uint32_t j, const glm::vec3& rgb) {
  const std::size_t n = std::size_t{image.height - 1 - j} * image.width + i;
  image.luminance[n] = luminance(rgb.r, rgb.g, rgb.b);
  image.colour[n] = rgb;
}

EmissionImage read_srgb(const std::string& bytes) {
  const Picture picture = read_picture(bytes, 3);
  EmissionImage image = make_image(picture.width, picture.height);
  const std::uint8_t* rgb = picture.values.data();
  for (std::uint32_t j = 0; j < image.height; ++j) {
    for (std::uint32_t i = 0; i < image.width; ++i, rgb += 3)
      set_texel(image, i, j, {linear(rgb[0]), linear(rgb[1]), linear(rgb[2])});
  }
  return image;
}

EmissionImage read_exr(const std::string& bytes) {
  Imf::StdISStream stream;
  stream.str(bytes);
  Imf::RgbaInputFile file(stream);
  const Imath::Box2i window = file.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                     height = std::int64_t{window.max.y} - window.min.y + 1;
  constexpr std::int64_t kTooMany = kMostEmissionTexels + 1;
  EmissionImage image = make_image(static_cast<std::uint32_t>(std::min(width, kTooMany)),
                                   static_cast<std::uint32_t>(std::min(height, kTooMany)));
  std::vector<Imf::Rgba> row(image.width);
  for (std::uint32_t j = 0; j < image.height; ++j) {
    const int y = window.min.y + static_cast<int>(j);
    // The row begins at the window's x and has y as its only row.
    file.setFrameBuffer(row.data() - window.min.x, 1, 0);
    file.readPixels(y);
    for (std::uint32_t i = 0; i < image.width; ++i) set_texel(image, i, j, {row[i].r, row[i].g, row[i].b});
  }
  return image;
}

}  // namespace

std::shared_ptr<const EmissionImage> read_emission(const std::string& bytes) {
  const bool is_exr = bytes.size() >= kExrMagic.size() &&
                      std::equal(kExrMagic.begin(), kExrMagic.end(), bytes.begin(),
                                 [](unsigned char a, char b) { return a == static_cast<unsigned char>(b); });
  EmissionImage image;
  try {
    image = is_exr ? read_exr(bytes) : read_srgb(bytes);
  } catch (const FormatFault&) {
    throw;
  } catch (const std::exception& fault) {
    throw FormatFault(std::string("is not an OpenEXR picture that can be read (") + fault.what() + ")");
  }
  return std::make_shared<const EmissionImage>(std::move(image));
}

}  // namespace pdsm
