// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace pdsm {

/// A picture, row 0 on top. What the numbers mean (linear light or display values) its maker says.
struct RgbImage {
  RgbImage() = default;
  RgbImage(std::uint32_t w, std::uint32_t h, const glm::vec3& fill = glm::vec3(0))
      : width(w), height(h), pixels(std::size_t{w} * h, fill) {}

  [[nodiscard]] glm::vec3& at(std::uint32_t x, std::uint32_t y) { return pixels[std::size_t{y} * width + x]; }

  std::uint32_t width = 0, height = 0;
  std::vector<glm::vec3> pixels;
};

/// A named plane of an EXR image, row 0 on top.
struct FloatPlane {
  std::string name;  ///< "R", "G", "B", "Y", ...
  std::vector<float> values;
};

enum class ImageFormat { png, exr };

/// By the end of the name. Throws Error (usage) "option: reason" for anything but .png and .exr.
[[nodiscard]] ImageFormat image_format(const std::filesystem::path& path, const std::string& option);

/// Writes display values 0..1 as 8 bits, whole or not at all. Throws Error (resource).
void write_png(const RgbImage& image, const std::filesystem::path& path);

/// Writes planes of 32-bit floats, whole or not at all. Throws Error (resource).
void write_exr(std::uint32_t width, std::uint32_t height, const std::vector<FloatPlane>& planes,
               const std::filesystem::path& path);

/// The planes R, G, B of an image.
[[nodiscard]] std::vector<FloatPlane> split_planes(const RgbImage& image);

}  // namespace pdsm
