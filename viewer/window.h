// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace pdsm {

/// What happened in the window since it was last asked.
struct WindowEvents {
  std::vector<int> pressed;  ///< keys, GLFW's numbers; repeats left out
  std::vector<std::filesystem::path> dropped;
  bool clicked = false;  ///< the left button went up about where it went down
  double scrolled = 0;   ///< steps, away from the person
  glm::dvec2 moved{0};   ///< of the cursor, in units of the window's shorter side; y down
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
  [[nodiscard]] bool is_button_down(int button) const;
  /// The cursor in pixels of the framebuffer from the upper left.
  [[nodiscard]] glm::dvec2 cursor() const;

  /// Polls, and hands over what came.
  [[nodiscard]] WindowEvents take_events();
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

  void listen();

  Library library_;
  std::unique_ptr<GLFWwindow, Destroy> window_;
  WindowEvents events_;
  glm::dvec2 last_cursor_{0}, press_{0};
};

}  // namespace pdsm
