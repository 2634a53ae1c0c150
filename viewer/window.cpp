// SPDX-License-Identifier: Apache-2.0
#include "window.h"

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Why GLFW's last call failed.
std::string last_reason(const std::string& otherwise) {
  const char* description = nullptr;
  return glfwGetError(&description) != GLFW_NO_ERROR && description != nullptr ? description : otherwise;
}

WindowEvents& events_of(GLFWwindow* window) {
  return *static_cast<WindowEvents*>(glfwGetWindowUserPointer(window));
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
  last_cursor_ = cursor();
  listen();
}

void Window::listen() {
  glfwSetWindowUserPointer(window_.get(), &events_);
  glfwSetKeyCallback(window_.get(), [](GLFWwindow* window, int key, int, int action, int) {
    if (action == GLFW_PRESS) events_of(window).pressed.push_back(key);
  });
  glfwSetScrollCallback(
      window_.get(), [](GLFWwindow* window, double, double steps) { events_of(window).scrolled += steps; });
  glfwSetDropCallback(window_.get(), [](GLFWwindow* window, int count, const char** paths) {
    for (int i = 0; i < count; ++i) events_of(window).dropped.emplace_back(paths[i]);
  });
}

glm::ivec2 Window::framebuffer_size() const {
  glm::ivec2 size(0);
  glfwGetFramebufferSize(window_.get(), &size.x, &size.y);
  return size;
}

double Window::scale() const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_.get(), &width, &height);
  return width > 0 ? static_cast<double>(framebuffer_size().x) / width : 1.0;
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

bool Window::is_button_down(int button) const {
  return glfwGetMouseButton(window_.get(), button) == GLFW_PRESS;
}

glm::dvec2 Window::cursor() const {
  glm::dvec2 place(0);
  glfwGetCursorPos(window_.get(), &place.x, &place.y);
  return place * scale();
}

WindowEvents Window::take_events() {
  constexpr double kStillAClick = 4;  // pixels
  const bool was_down = is_button_down(GLFW_MOUSE_BUTTON_LEFT);
  glfwPollEvents();
  const glm::dvec2 place = cursor();
  const bool is_down_now = is_button_down(GLFW_MOUSE_BUTTON_LEFT);
  if (!was_down && is_down_now) press_ = place;
  events_.clicked = was_down && !is_down_now && glm::distance(press_, place) <= kStillAClick;
  const glm::ivec2 size = framebuffer_size();
  events_.moved = (place - last_cursor_) / static_cast<double>(std::max(1, std::min(size.x, size.y)));
  last_cursor_ = place;
  return std::exchange(events_, {});
}

void Window::swap() const {
  glfwSwapBuffers(window_.get());
}

}  // namespace pdsm
