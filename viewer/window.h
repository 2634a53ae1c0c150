// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "mouse_track.h"

struct GLFWwindow;

namespace pdsm {

/// A key that went down; repeats are left out.
struct KeyPress {
  int key = 0;  ///< GLFW's number
  bool shift = false;
};

/// What happened in the window since it was last asked.
struct WindowEvents {
  std::vector<KeyPress> pressed;
  std::vector<std::filesystem::path> dropped;
  MouseEvents mouse;
};

/// A window with an OpenGL 3.3 core context, current on the thread that made it. One at a time.
class Window {
 public:
  /// Throws Error (resource) "display: reason" without a display or a GL that will do.
  Window(const std::string& title, int width, int height, bool visible);
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  [[nodiscard]] GLFWwindow* handle() const { return window_.get(); }
  [[nodiscard]] glm::ivec2 framebuffer_size() const;
  /// Pixels of the framebuffer a unit of the window.
  [[nodiscard]] double scale() const;
  /// How much larger than usual panels have to be on this display, in units of the window.
  [[nodiscard]] double interface_scale() const;
  [[nodiscard]] bool should_close() const;
  [[nodiscard]] bool is_down(int key) const;
  /// The cursor in pixels of the framebuffer from the upper left.
  [[nodiscard]] glm::dvec2 cursor() const;

  /// Hands over what came; waits up to `seconds` for something to come.
  [[nodiscard]] WindowEvents take_events(double seconds = 0);
  void swap() const;

 private:
  /// GLFW's own initialisation.
  struct Library {
    Library();
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
  };
  struct Destroy {
    void operator()(GLFWwindow* window) const;
  };

  struct Pending {
    WindowEvents events;
    MouseTrack mouse;
  };

  void listen();
  [[nodiscard]] static Pending& pending_of(GLFWwindow* window);

  Library library_;
  std::unique_ptr<GLFWwindow, Destroy> window_;
  Pending pending_;
};

}  // namespace pdsm
