// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "evaluate/image_io.h"

namespace pdsm {

/// Draws text with its upper left corner at (x, y); a glyph is about 6 x 9 pixels times `scale`.
void draw_text(RgbImage& image, int x, int y, int scale, const std::string& text, const glm::vec3& colour);

/// Where a scale of values > 0 should end: a round number (1, 2 or 5 times a power of ten, 1e-4 .. 1) that is
/// not below their 99th percentile; 0.01 when there are none.
[[nodiscard]] double heat_map_top(std::span<const float> values);

/// A picture of values >= 0 in display values: heat colours up to a round number near the 99th percentile,
/// with a scale of ticks and `title` in a strip that is added below. `backdrop`, when not empty, is a faint
/// shading 0..1 that shows where nothing differs; a value < 0 is nothing, drawn as plain background.
[[nodiscard]] RgbImage draw_heat_map(std::uint32_t width, std::uint32_t height, std::span<const float> values,
                                     std::span<const float> backdrop, const std::string& title);

}  // namespace pdsm
