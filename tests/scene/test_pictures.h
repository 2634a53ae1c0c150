// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// Bytes of small picture files.
namespace pdsm::test {

/// A PNG of `channels` (1: grey, 2: grey and alpha, 3: RGB, 4: RGBA) x 8 bits; `pixels` row by row.
std::string png(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                const std::vector<std::uint8_t>& pixels);

/// A PNG of indices into a palette of as many greys as `transparency` has entries (tRNS).
std::string palette_png(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& indices,
                        const std::vector<std::uint8_t>& transparency);

/// A TGA of 8 bits of grey, the top row first.
std::string grey_tga(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& pixels);

/// A JPEG of 8 x 8 equal pixels.
std::string grey_jpeg(std::uint8_t value);

/// Bytes as text.
std::string base64(const std::string& bytes);

}  // namespace pdsm::test
