// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session.h"
#include "ui/ui_state.h"

struct GLFWwindow;

namespace pdsm {

/// Dear ImGui and the viewer's panels, `scale` times as large as usual. Needs the window's context; make it
/// after the window's own callbacks are set.
class UserInterface {
 public:
  UserInterface(GLFWwindow* window, float scale);
  ~UserInterface();
  UserInterface(const UserInterface&) = delete;
  UserInterface& operator=(const UserInterface&) = delete;

  /// Lays the panels out; changes what a person changes in them. `seconds`: since the last frame.
  void update(Session& session, UiState& state, double seconds);
  /// Draws them into the framebuffer that is bound.
  void draw() const;

  [[nodiscard]] bool wants_mouse() const;
  [[nodiscard]] bool wants_keyboard() const;
};

}  // namespace pdsm
