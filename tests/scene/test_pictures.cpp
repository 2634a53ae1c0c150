// SPDX-License-Identifier: Apache-2.0
#include "test_pictures.h"

#include <zlib.h>

#include <stdexcept>

#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace pdsm::test {
namespace {

std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
          static_cast<char>(value)};
}

std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto* bytes = reinterpret_cast<const Bytef*>(body.data());
  return big_endian(static_cast<std::uint32_t>(data.size())) + body +
         big_endian(static_cast<std::uint32_t>(crc32(0, bytes, static_cast<uInt>(body.size()))));
}

std::string text(const std::vector<std::uint8_t>& bytes) {
  return {bytes.begin(), bytes.end()};
}

std::string packed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
               bytes.size()) != Z_OK)
    throw std::runtime_error("compress");
  result.resize(size);
  return result;
}

std::string png_of(std::uint32_t width, std::uint32_t height, char colour_type, std::uint32_t channels,
                   const std::vector<std::uint8_t>& pixels, const std::string& palette) {
  std::string rows;
  for (std::uint32_t y = 0; y < height; ++y)
    rows += '\0' + text(pixels).substr(std::size_t{y} * width * channels, std::size_t{width} * channels);
  std::string header = big_endian(width) + big_endian(height) + '\x08' + colour_type + std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + palette + chunk("IDAT", packed(rows)) +
         chunk("IEND", "");
}

}  // namespace

std::string png(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                const std::vector<std::uint8_t>& pixels) {
  constexpr char kTypes[] = {0, 4, 2, 6};
  return png_of(width, height, kTypes[channels - 1], channels, pixels, "");
}

std::string palette_png(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& indices,
                        const std::vector<std::uint8_t>& transparency) {
  std::string colours;
  for (std::size_t n = 0; n < transparency.size(); ++n) colours += std::string(3, static_cast<char>(n));
  return png_of(width, height, 3, 1, indices, chunk("PLTE", colours) + chunk("tRNS", text(transparency)));
}

std::string grey_tga(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& pixels) {
  std::string header(18, '\0');
  header[2] = 3;  // grey, not packed
  header[12] = static_cast<char>(width);
  header[14] = static_cast<char>(height);
  header[16] = 8;
  header[17] = 0x20;  // the top row first
  return header + text(pixels);
}

std::string grey_jpeg(std::uint8_t value) {
  const std::vector<std::uint8_t> pixels(64, value);
  std::string bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  constexpr int kQuality = 100;
  if (stbi_write_jpg_to_func(append, &bytes, 8, 8, 1, pixels.data(), kQuality) == 0)
    throw std::runtime_error("stbi_write_jpg_to_func");
  return bytes;
}

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8 | (n + i < bytes.size() ? static_cast<std::uint8_t>(bytes[n + i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i)
      result += n + i > bytes.size() ? '=' : kDigits[group >> (18 - 6 * i) & 63U];
  }
  return result;
}

}  // namespace pdsm::test
