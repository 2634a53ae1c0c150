// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

#include "arguments.h"
#include "camera_control.h"
#include "scene_renderer.h"
#include "session.h"
#include "ui/ui_state.h"
#include "ui/user_interface.h"
#include "window.h"

namespace pdsm {

/// The viewer: a window, what it shows, and what a person does to it.
class Application {
 public:
  /// Reads the files first, so that a bad one is told without a window. Throws Error.
  explicit Application(const Arguments& arguments);

  /// Until the window is closed.
  void run();
  /// Draws the arguments' frames, writes the screenshot; in mode error prints the numbers. Throws Error.
  void run_for_screenshot();

 private:
  void frame_scene();
  void welcome_scene();
  void advance(double seconds);
  void handle_keys(const std::vector<KeyPress>& pressed, double seconds);
  void handle_buttons();
  void handle_mouse(const MouseEvents& mouse);
  void handle_key(const KeyPress& press);
  void drag_camera(const MouseEvents& mouse);
  void fly_camera(const std::vector<KeyPress>& pressed, double seconds);
  void take_files(const std::vector<std::filesystem::path>& files);
  void watch_files();
  void synchronize();
  void draw(bool truth_at_once);
  void draw_interface();
  [[nodiscard]] std::optional<glm::dvec3> surface_under_cursor() const;
  [[nodiscard]] std::optional<glm::dvec3> surface_at(const glm::dvec2& place) const;
  [[nodiscard]] bool shows_function() const;
  void update_probe();
  void take_screenshot(bool with_interface);

  Arguments arguments_;
  Session session_;
  Window window_;
  UserInterface interface_;
  SceneRenderer renderer_;
  CameraControl camera_;
  UiState state_;
  double seconds_ = 0;
  std::chrono::steady_clock::time_point watched_;
  std::optional<bool> screenshot_wanted_;  // with the panels or without
};

}  // namespace pdsm
