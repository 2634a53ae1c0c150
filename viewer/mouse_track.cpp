// SPDX-License-Identifier: Apache-2.0
#include "mouse_track.h"

#include <utility>

namespace pdsm {

void MouseTrack::move(const glm::dvec2& place) {
  for (std::size_t button = 0; button < kMouseButtons; ++button) {
    if (down_[button]) events_.dragged[button] += place - place_;
  }
  place_ = place;
}

void MouseTrack::press(MouseButton button) {
  down_[static_cast<std::size_t>(button)] = true;
  if (button == MouseButton::left) press_ = place_;
}

void MouseTrack::release(MouseButton button) {
  constexpr double kStillAClick = 4;  // pixels
  bool& down = down_[static_cast<std::size_t>(button)];
  const bool is_click = down && button == MouseButton::left && glm::distance(press_, place_) <= kStillAClick;
  if (is_click) events_.clicked = press_;
  down = false;
}

MouseEvents MouseTrack::take() {
  return std::exchange(events_, {});
}

}  // namespace pdsm
