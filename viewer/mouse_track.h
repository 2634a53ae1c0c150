// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>

namespace pdsm {

/// Buttons that mean something, in GLFW's order.
enum class MouseButton : std::size_t { left, right, middle };
inline constexpr std::size_t kMouseButtons = 3;

/// What the mouse did between two frames.
struct MouseEvents {
  std::optional<glm::dvec2> clicked;  ///< where the left button was pressed that then went up about there
  std::array<glm::dvec2, kMouseButtons> dragged{};  ///< way of the cursor while each button was down
  double scrolled = 0;                              ///< steps, away from the person

  [[nodiscard]] const glm::dvec2& drag(MouseButton button) const {
    return dragged[static_cast<std::size_t>(button)];
  }
};

/// Follows the mouse from event to event: a frame may be slower than a click, and what the cursor did before
/// a button went down is no drag. Places are in pixels from the upper left.
class MouseTrack {
 public:
  void move(const glm::dvec2& place);
  /// Buttons change at the place of the last move().
  void press(MouseButton button);
  void release(MouseButton button);
  void scroll(double steps) { events_.scrolled += steps; }

  /// What was done since it was last asked.
  [[nodiscard]] MouseEvents take();

 private:
  MouseEvents events_;
  glm::dvec2 place_{0}, press_{0};
  std::array<bool, kMouseButtons> down_{};
};

}  // namespace pdsm
