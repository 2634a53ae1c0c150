// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "evaluate/camera.h"
#include "evaluate/image_io.h"

namespace pdsm {

/// A PNG of 8 bits a channel. Display values; empty when it can't be read.
[[nodiscard]] RgbImage read_png(const std::filesystem::path& path);

/// How far two pictures of one size are apart, over pixels and channels.
struct PictureDifference {
  double mean = 0, max = 0;
};
[[nodiscard]] PictureDifference compare(const RgbImage& a, const RgbImage& b);

/// Mean brightness 0..1.
[[nodiscard]] double brightness(const RgbImage& image);

/// The pixel that shows a world point.
[[nodiscard]] glm::uvec2 pixel_of(const Camera& camera, const RgbImage& image, const glm::dvec3& point);

}  // namespace pdsm
