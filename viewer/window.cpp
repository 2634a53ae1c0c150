// SPDX-License-Identifier: Apache-2.0
#include "window.h"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <optional>
#include <utility>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Why GLFW's last call failed.
std::string last_reason(const std::string& otherwise) {
  const char* description = nullptr;
  return glfwGetError(&description) != GLFW_NO_ERROR && description != nullptr ? description : otherwise;
}

/// Pixels of the framebuffer a unit of the window.
double scale_of(GLFWwindow* window) {
  int width = 0, height = 0;
  glfwGetWindowSize(window, &width, &height);
  int pixels = 0;
  glfwGetFramebufferSize(window, &pixels, &height);
  return width > 0 ? static_cast<double>(pixels) / width : 1.0;
}

std::optional<MouseButton> known_button(int button) {
  if (button == GLFW_MOUSE_BUTTON_LEFT) return MouseButton::left;
  if (button == GLFW_MOUSE_BUTTON_RIGHT) return MouseButton::right;
  if (button == GLFW_MOUSE_BUTTON_MIDDLE) return MouseButton::middle;
  return std::nullopt;
}

}  // namespace

Window::Library::Library() {
  if (glfwInit() != GLFW_TRUE) throw Error(Failure::resource, "display", last_reason("can't be opened"));
}

Window::Library::~Library() {
  glfwTerminate();
}

void Window::Destroy::operator()(GLFWwindow* window) const {
  glfwDestroyWindow(window);
}

Window::Window(const std::string& title, int width, int height, bool visible) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  window_.reset(glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr));
  if (!window_) throw Error(Failure::resource, "display", last_reason("has no OpenGL 3.3"));
  glfwMakeContextCurrent(window_.get());
  glfwSwapInterval(visible ? 1 : 0);
  listen();
}

Window::Pending& Window::pending_of(GLFWwindow* window) {
  return *static_cast<Pending*>(glfwGetWindowUserPointer(window));
}

void Window::listen() {
  pending_.mouse.move(cursor());
  glfwSetWindowUserPointer(window_.get(), &pending_);
  glfwSetKeyCallback(window_.get(), [](GLFWwindow* window, int key, int, int action, int modifiers) {
    if (action != GLFW_PRESS) return;
    pending_of(window).events.pressed.push_back({key, (modifiers & GLFW_MOD_SHIFT) != 0});
  });
  glfwSetCursorPosCallback(window_.get(), [](GLFWwindow* window, double x, double y) {
    pending_of(window).mouse.move(scale_of(window) * glm::dvec2(x, y));
  });
  glfwSetMouseButtonCallback(window_.get(), [](GLFWwindow* window, int number, int action, int) {
    const std::optional<MouseButton> button = known_button(number);
    if (!button) return;
    MouseTrack& mouse = pending_of(window).mouse;
    action == GLFW_PRESS ? mouse.press(*button) : mouse.release(*button);
  });
  glfwSetScrollCallback(window_.get(), [](GLFWwindow* window, double, double steps) {
    pending_of(window).mouse.scroll(steps);
  });
  glfwSetDropCallback(window_.get(), [](GLFWwindow* window, int count, const char** paths) {
    for (int i = 0; i < count; ++i) pending_of(window).events.dropped.emplace_back(paths[i]);
  });
}

glm::ivec2 Window::framebuffer_size() const {
  glm::ivec2 size(0);
  glfwGetFramebufferSize(window_.get(), &size.x, &size.y);
  return size;
}

double Window::scale() const {
  return scale_of(window_.get());
}

double Window::interface_scale() const {
  float across = 1, up = 1;
  glfwGetWindowContentScale(window_.get(), &across, &up);
  return static_cast<double>(across) / scale();
}

bool Window::should_close() const {
  return glfwWindowShouldClose(window_.get()) == GLFW_TRUE;
}

bool Window::is_down(int key) const {
  return glfwGetKey(window_.get(), key) == GLFW_PRESS;
}

glm::dvec2 Window::cursor() const {
  glm::dvec2 place(0);
  glfwGetCursorPos(window_.get(), &place.x, &place.y);
  return place * scale();
}

WindowEvents Window::take_events(double seconds) {
  seconds > 0 ? glfwWaitEventsTimeout(seconds) : glfwPollEvents();
  WindowEvents events = std::exchange(pending_.events, {});
  events.mouse = pending_.mouse.take();
  return events;
}

void Window::swap() const {
  glfwSwapBuffers(window_.get());
}

}  // namespace pdsm
