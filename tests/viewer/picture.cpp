// SPDX-License-Identifier: Apache-2.0
#include "picture.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

namespace pdsm {

RgbImage read_png(const std::filesystem::path& path) {
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> bytes(
      stbi_load(path.c_str(), &width, &height, &channels, 3), stbi_image_free);
  if (!bytes) return {};
  RgbImage image(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const stbi_uc* pixel = bytes.get() + 3 * i;
    image.pixels[i] = glm::vec3(pixel[0], pixel[1], pixel[2]) / 255.0F;
  }
  return image;
}

PictureDifference compare(const RgbImage& a, const RgbImage& b) {
  PictureDifference difference;
  if (a.width != b.width || a.height != b.height || a.pixels.empty()) return {1, 1};
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::vec3 d = glm::abs(a.pixels[i] - b.pixels[i]);
    difference.mean += static_cast<double>(d.r + d.g + d.b) / 3;
    difference.max = std::max(difference.max, static_cast<double>(std::max({d.r, d.g, d.b})));
  }
  difference.mean /= static_cast<double>(a.pixels.size());
  return difference;
}

double brightness(const RgbImage& image) {
  double sum = 0;
  for (const glm::vec3& pixel : image.pixels) sum += static_cast<double>(pixel.r + pixel.g + pixel.b) / 3;
  return sum / static_cast<double>(std::max<std::size_t>(1, image.pixels.size()));
}

glm::uvec2 pixel_of(const Camera& camera, const RgbImage& image, const glm::dvec3& point) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  const glm::dvec3 up = glm::cross(right, forward);
  const double shorter = std::min(image.width, image.height);
  const double per_pixel = std::tan(0.5 * camera.fov * std::numbers::pi / 180) / (0.5 * shorter);
  const glm::dvec3 away = point - camera.eye;
  const double depth = glm::dot(away, forward) * per_pixel;
  return {static_cast<std::uint32_t>(0.5 * image.width + glm::dot(away, right) / depth),
          static_cast<std::uint32_t>(0.5 * image.height - glm::dot(away, up) / depth)};
}

}  // namespace pdsm
