// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace pdsm {

/// Linear light to display values (the sRGB curve), each channel clamped to 0..1.
[[nodiscard]] glm::vec3 display_values(const glm::vec3& linear);

/// Scene light to display light 0..1: a straight middle, a soft toe and a shoulder, like film.
[[nodiscard]] glm::vec3 film_curve(const glm::vec3& light);

/// Colour of a value 0..1 in display values: from near-black violet over red to pale yellow. Lightness
/// rises evenly, so that equal steps look equal, in grey too.
[[nodiscard]] glm::vec3 heat_colour(double value);

}  // namespace pdsm
