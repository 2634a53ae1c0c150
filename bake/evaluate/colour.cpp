// SPDX-License-Identifier: Apache-2.0
#include "evaluate/colour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// Colour space of heat_colour: Ottosson, "A perceptual color space for image processing" (Oklab), 2020.
namespace pdsm {
namespace {

float display_value(float linear) {
  const float x = std::clamp(linear, 0.0F, 1.0F);
  return x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
}

float film_value(float light) {
  // x^c / (x^c + m^c), scaled to reach 1 at `kWhite`; c > 1 gives the toe.
  constexpr float kContrast = 1.22F, kMiddle = 0.86F, kWhite = 5.0F;
  const float x = std::pow(std::max(light, 0.0F), kContrast);
  const float top = std::pow(kWhite, kContrast), middle = std::pow(kMiddle, kContrast);
  return std::min(1.0F, x / (x + middle) * (top + middle) / top);
}

/// Oklab lightness, chroma and hue (radians) to linear sRGB.
glm::dvec3 linear_from_oklch(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  const double l = lightness + 0.3963377774 * a + 0.2158037573 * b;
  const double m = lightness - 0.1055613458 * a - 0.0638541728 * b;
  const double s = lightness - 0.0894841775 * a - 1.2914855480 * b;
  const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
  return {4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3,
          -1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3,
          -0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3};
}

}  // namespace

glm::vec3 display_values(const glm::vec3& linear) {
  return {display_value(linear.x), display_value(linear.y), display_value(linear.z)};
}

glm::vec3 film_curve(const glm::vec3& light) {
  return {film_value(light.x), film_value(light.y), film_value(light.z)};
}

glm::vec3 heat_colour(double value) {
  constexpr double kDegrees = std::numbers::pi / 180;
  const double t = std::clamp(value, 0.0, 1.0);
  // Lightness is linear; the hue turns the short way from violet over red to yellow; chroma swells in
  // the middle, within what a display can show.
  const double lightness = 0.18 + 0.78 * t;
  const double chroma = 0.05 + 0.145 * std::pow(std::sin(std::numbers::pi * (0.1 + 0.72 * t)), 1.3);
  const double hue = (282 + 184 * t) * kDegrees;
  return display_values(glm::vec3(linear_from_oklch(lightness, chroma, hue)));
}

}  // namespace pdsm
