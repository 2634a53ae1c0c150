// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

#include "evaluate/focus.h"
#include "pdsm/bake/scene.h"

/// The studio in which scenes are shown: a soft sky, light that bounces off the ground, a plain background.
/// Linear RGB, relative to a lit white surface. All functions are pure.
namespace pdsm {

inline constexpr glm::vec3 kStudioSky{0.24F, 0.285F, 0.36F}, kStudioBounce{0.20F, 0.175F, 0.15F};
inline constexpr glm::vec3 kStudioHorizon{0.185F, 0.215F, 0.26F}, kStudioZenith{0.075F, 0.09F, 0.115F};
/// direction.y at which the background is all zenith; it begins at 0.
inline constexpr double kStudioZenithHeight = 0.7;
inline constexpr float kStudioKeyStrength = 2.3F;
/// In radii of the focus: what lamps in the middle of rooms shine on is about as far away.
inline constexpr double kStudioLeastDistance = 0.6;
/// From where to where surfaces fade into the background, in radii of the focus.
inline constexpr double kStudioFadeBegin = 2.0, kStudioFadeEnd = 6.0;

/// A light by a 3 x 3 grid of points of equal areas.
struct StudioLight {
  /// World, metres; of a distant light unit vectors towards it. The centre is points[4].
  std::array<glm::dvec3, 9> points{};
  bool distant = false;
  glm::dvec3 direction{0};  ///< unit; 0 of a light that shines to all sides
  bool two_sided = false;   ///< shines against `direction`, too
  glm::vec3 colour{1};      ///< times irradiance(): light that arrives
};

/// Colour of light `index` of `count` at the focus: white ones look dull side by side, and lights seldom
/// all shine on one surface, so that together they are brighter than one.
[[nodiscard]] glm::vec3 studio_colour(std::size_t index, std::size_t count);

/// The light as bright as makes a white surface at the focus, turned to it, `colour`. Of a light nearer than
/// kStudioLeastDistance to the focus it is one at that distance, in the same direction, and of one that does
/// not shine there one two radii in front of it.
[[nodiscard]] StudioLight make_studio_light(const Light& light, const Focus& focus, const glm::vec3& colour);

/// What arrives from the light's points on a surface, both cosines and 1 / distance^2 (metres; 1 for a
/// distant light) included.
[[nodiscard]] float irradiance(const StudioLight& light, const glm::dvec3& position, const glm::vec3& normal);

[[nodiscard]] glm::vec3 studio_background(const glm::dvec3& direction);

/// Share of the background in what is seen of a surface at `position` (metres), 0..1.
[[nodiscard]] float studio_fade(const Focus& focus, const glm::dvec3& position);

}  // namespace pdsm
