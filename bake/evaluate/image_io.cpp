// SPDX-License-Identifier: Apache-2.0
#include "evaluate/image_io.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "pdsm/format/atomic_file.h"
#include "pdsm/format/error.h"

// Our own copy of the functions, whatever other libraries bring along.
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace pdsm {
namespace {

std::uint8_t to_byte(float value) {
  const float inside = value > 0 ? std::min(value, 1.0F) : 0.0F;  // NaN becomes 0
  return static_cast<std::uint8_t>(std::lround(255 * inside));
}

void append_bytes(void* context, void* data, int size) {
  auto& bytes = *static_cast<std::vector<std::byte>*>(context);
  const auto* first = static_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), first, first + size);
}

/// An Imf slice over floats that are only read.
Imf::Slice slice_of(const FloatPlane& plane, std::uint32_t width) {
  auto* base = const_cast<char*>(reinterpret_cast<const char*>(plane.values.data()));
  return {Imf::FLOAT, base, sizeof(float), sizeof(float) * width};
}

}  // namespace

ImageFormat image_format(const std::filesystem::path& path, const std::string& option) {
  if (path.extension() == ".png") return ImageFormat::png;
  if (path.extension() == ".exr") return ImageFormat::exr;
  throw Error(Failure::usage, option, "must end in .png or .exr, not '" + path.string() + "'");
}

void write_png(const RgbImage& image, const std::filesystem::path& path) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * image.pixels.size());
  for (const glm::vec3& pixel : image.pixels) {
    for (int channel = 0; channel < 3; ++channel) rgb.push_back(to_byte(pixel[channel]));
  }
  std::vector<std::byte> bytes;
  const auto width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  if (stbi_write_png_to_func(append_bytes, &bytes, width, height, 3, rgb.data(), 3 * width) == 0) {
    throw Error(Failure::resource, path.string(), "the picture can't be encoded");
  }
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void write_exr(std::uint32_t width, std::uint32_t height, const std::vector<FloatPlane>& planes,
               const std::filesystem::path& path) {
  AtomicFile file(path);
  try {
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    Imf::FrameBuffer frame;
    for (const FloatPlane& plane : planes) {
      header.channels().insert(plane.name, Imf::Channel(Imf::FLOAT));
      frame.insert(plane.name, slice_of(plane, width));
    }
    Imf::OutputFile output(file.temporary().c_str(), header);
    output.setFrameBuffer(frame);
    output.writePixels(static_cast<int>(height));
  } catch (const std::exception& error) {
    throw Error(Failure::resource, path.string(), error.what());
  }
  file.commit();
}

std::vector<FloatPlane> split_planes(const RgbImage& image) {
  std::vector<FloatPlane> planes{{"R", {}}, {"G", {}}, {"B", {}}};
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<float>& values = planes[static_cast<std::size_t>(channel)].values;
    values.reserve(image.pixels.size());
    for (const glm::vec3& pixel : image.pixels) values.push_back(pixel[channel]);
  }
  return planes;
}

}  // namespace pdsm
