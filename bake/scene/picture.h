// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace pdsm {

inline constexpr std::uint32_t kMostPictureTexels = 16384;  ///< along an axis

/// A decoded picture of 8 bits a channel.
struct Picture {
  std::uint32_t width = 0, height = 0, channels = 0;
  std::uint32_t file_channels = 0;   ///< the file's own: 1 grey, 2 and alpha, 3 colour, 4 and alpha
  std::vector<std::uint8_t> values;  ///< row by row from the top, `channels` a texel
};

/// Reads a PNG, JPEG or TGA picture, a palette's transparency included, with 1 to 4 `channels` as told above.
/// Throws FormatFault with the reason.
[[nodiscard]] Picture read_picture(std::string_view bytes, std::uint32_t channels);

}  // namespace pdsm
