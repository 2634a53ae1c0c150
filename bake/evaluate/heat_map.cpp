// SPDX-License-Identifier: Apache-2.0
#include "evaluate/heat_map.h"

#include <fmt/format.h>
#include <stb_easy_font.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "evaluate/colour.h"

namespace pdsm {
namespace {

const glm::vec3 kPaper(0.93F), kInk(0.13F), kNothing(0.80F);

/// Corners of a filled rectangle in pixels, the far ones excluded.
struct Box {
  int left, top, right, bottom;
};

void fill_box(RgbImage& image, const Box& box, const glm::vec3& colour) {
  const int right = std::min(box.right, static_cast<int>(image.width));
  const int bottom = std::min(box.bottom, static_cast<int>(image.height));
  for (int y = std::max(box.top, 0); y < bottom; ++y) {
    for (int x = std::max(box.left, 0); x < right; ++x) {
      image.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) = colour;
    }
  }
}

int text_width(const std::string& text, int scale) {
  std::string copy = text;
  return scale * stb_easy_font_width(copy.data());
}

/// The scale below the picture: colours, five ticks, the title.
void draw_strip(RgbImage& image, int top, int scale, double top_value, const std::string& title) {
  const int width = static_cast<int>(image.width), margin = 10 * scale;
  fill_box(image, {0, top, width, static_cast<int>(image.height)}, kPaper);
  const int bar = std::min(width - 2 * margin - 20 * scale, 220 * scale);
  const int bar_top = top + 8 * scale, bar_bottom = bar_top + 10 * scale;
  for (int x = 0; x < bar; ++x) {
    fill_box(image, {margin + x, bar_top, margin + x + 1, bar_bottom}, heat_colour((x + 0.5) / bar));
  }
  constexpr int kTicks = 4;
  for (int tick = 0; tick <= kTicks; ++tick) {
    const int x = margin + bar * tick / kTicks;
    fill_box(image, {x, bar_bottom, x + scale, bar_bottom + 3 * scale}, kInk);
    const std::string label = fmt::format("{:.3g}", top_value * tick / kTicks);
    const int left = std::max(2, x - text_width(label, scale) / 2);
    draw_text(image, left, bar_bottom + 5 * scale, scale, label, kInk);
  }
  draw_text(image, margin, bar_bottom + 18 * scale, scale, title, kInk);
}

}  // namespace

double heat_map_top(std::span<const float> values) {
  std::vector<float> seen;
  std::copy_if(values.begin(), values.end(), std::back_inserter(seen), [](float v) { return v > 0; });
  if (seen.empty()) return 0.01;
  const auto rank = seen.begin() + static_cast<std::ptrdiff_t>((seen.size() - 1) * 99 / 100);
  std::nth_element(seen.begin(), rank, seen.end());
  const double wanted = std::clamp(static_cast<double>(*rank), 1e-4, 1.0);
  const double power = std::pow(10.0, std::floor(std::log10(wanted) + 1e-6));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= wanted * (1 - 1e-6)) return step * power;
  }
  return 10 * power;
}

void draw_text(RgbImage& image, int x, int y, int scale, const std::string& text, const glm::vec3& colour) {
  struct Vertex {
    float x, y, z;
    std::array<unsigned char, 4> colour;
  };
  // The font takes about 270 bytes a character.
  std::vector<Vertex> vertices(text.size() * 40 + 64);
  std::string copy = text;
  const int quads = stb_easy_font_print(0, 0, copy.data(), nullptr, vertices.data(),
                                        static_cast<int>(vertices.size() * sizeof(Vertex)));
  for (int quad = 0; quad < quads; ++quad) {
    // Corners go around; the third is opposite the first.
    const Vertex& first = vertices[static_cast<std::size_t>(4 * quad)];
    const Vertex& third = vertices[static_cast<std::size_t>(4 * quad + 2)];
    const auto pixel = [scale](float v) { return static_cast<int>(std::lround(v)) * scale; };
    fill_box(image, {x + pixel(first.x), y + pixel(first.y), x + pixel(third.x), y + pixel(third.y)}, colour);
  }
}

RgbImage draw_heat_map(std::uint32_t width, std::uint32_t height, std::span<const float> values,
                       std::span<const float> backdrop, const std::string& title) {
  constexpr float kBackdropShare = 0.16F;
  constexpr std::uint32_t kLargeText = 900;  // pixels of width from which one-pixel strokes get lost
  const int scale = width >= kLargeText ? 2 : 1;
  const auto strip = static_cast<std::uint32_t>(50 * scale);
  const double top_value = heat_map_top(values);

  RgbImage image(width, height + strip, kNothing);
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!(values[n] >= 0)) continue;
    const double share = values[n] / top_value;
    const float shade = backdrop.empty() ? 0.0F : backdrop[n];
    const auto room = static_cast<float>(std::max(0.0, 1 - share));
    image.pixels[n] = heat_colour(share) + glm::vec3(kBackdropShare * shade * room);
  }
  draw_strip(image, static_cast<int>(height), scale, top_value, title);
  return image;
}

}  // namespace pdsm
