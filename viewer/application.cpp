// SPDX-License-Identifier: Apache-2.0
#include "application.h"

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

#include "cli/inputs.h"
#include "cli/streams.h"
#include "evaluate/image_io.h"
#include "object_path.h"
#include "pdsm/format/error.h"
#include "screenshot.h"

namespace pdsm {
namespace {

constexpr double kFrameSeconds = 1.0 / 60;
/// Time between looks at the files.
constexpr std::chrono::milliseconds kWatchTime{500};
constexpr int kWatchFrames = 30;  // of fixed length, that long

Session open_session(const Arguments& arguments) {
  Session session;
  if (arguments.scene) session.open(*arguments.scene, arguments.maps);
  if (arguments.screenshot) {
    std::vector<std::filesystem::path> inputs = scene_inputs(*arguments.scene);
    inputs.insert(inputs.end(), arguments.maps.begin(), arguments.maps.end());
    check_output(*arguments.screenshot, inputs);
  }
  return session;
}

}  // namespace

Application::Application(const Arguments& arguments)
    : arguments_(arguments),
      session_(open_session(arguments)),
      window_("pdsm", arguments.width, arguments.height, !arguments.screenshot),
      interface_(window_.handle(), static_cast<float>(window_.interface_scale())) {
  state_.settings = arguments.settings;
  welcome_scene();
  if (arguments.camera && session_.stage()) camera_.set(*arguments.camera, session_.stage()->focus().radius);
  renderer_.synchronize(session_, state_.settings);
}

void Application::frame_scene() {
  if (!session_.stage()) return;
  const Stage& stage = *session_.stage();
  camera_.set(stage.camera(), stage.focus().radius);
}

void Application::welcome_scene() {
  frame_scene();
  state_.pinned.reset();
  state_.light = 0;
  if (!session_.library().maps().empty()) state_.light = session_.library().maps().front().light;
  if (session_.stage()) choose_path(*session_.stage(), session_.library(), state_.settings);
}

void Application::run() {
  auto last = std::chrono::steady_clock::now();
  while (!window_.should_close()) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last).count();
    last = now;
    state_.times.add(seconds);
    handle(window_.take_events(), seconds);
    watch_files();
    advance(std::min(seconds, 0.25));
    draw(false);
    interface_.update(session_, state_, seconds);
    if (screenshot_wanted_ == false) take_screenshot(false);
    draw_interface();
    if (screenshot_wanted_ == true) take_screenshot(true);
    renderer_.targets().show();
    window_.swap();
  }
}

void Application::run_for_screenshot() {
  for (int frame = 1; frame <= arguments_.frames; ++frame) {
    (void)window_.take_events();
    const bool last = frame == arguments_.frames;
    if (last || frame % kWatchFrames == 0) session_.refresh();
    synchronize();
    seconds_ = frame * kFrameSeconds;
    const auto begin = std::chrono::steady_clock::now();
    draw(last);
    glFinish();
    state_.times.add(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  const Mode mode = state_.settings.mode;
  if (mode == Mode::truth || mode == Mode::error) renderer_.truth().finish();
  for (int picture = 1; picture < SceneRenderer::kMostPictures; ++picture) draw(true);
  if (mode == Mode::error) {
    const DifferenceSummary& error = renderer_.truth().numbers();
    write_result(fmt::format("pixels {}\nmean {:.6f}\nrms {:.6f}\nmax {:.6f}\n", error.pixels, error.mean_abs,
                             error.rms, error.max));
  }
  if (arguments_.show_ui) {
    // The first layout finds the panels' sizes.
    interface_.update(session_, state_, kFrameSeconds);
    interface_.update(session_, state_, kFrameSeconds);
    draw_interface();
  }
  write_png(renderer_.targets().read(), *arguments_.screenshot);
}

void Application::advance(double seconds) {
  // The truth is of a moment.
  const bool still =
      state_.settings.paused || state_.settings.mode == Mode::truth || state_.settings.mode == Mode::error;
  if (!still) seconds_ += seconds;
}

void Application::handle(const WindowEvents& events, double seconds) {
  if (!events.dropped.empty()) {
    const auto version = session_.stage_version();
    session_.drop(events.dropped);
    if (session_.stage_version() != version) welcome_scene();
  }
  if (!interface_.wants_keyboard()) {
    for (const int key : events.pressed) handle_key(key);
  }
  if (state_.frame_scene) frame_scene();
  state_.frame_scene = false;
  if (state_.screenshot) screenshot_wanted_ = state_.screenshot;
  state_.screenshot.reset();
  if (!interface_.wants_mouse()) {
    move_camera(events, seconds);
    if (events.clicked) state_.pinned = surface_under_cursor();
  }
}

void Application::handle_key(int key) {
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_6) state_.settings.mode = static_cast<Mode>(key - GLFW_KEY_1);
  if (key == GLFW_KEY_F) frame_scene();
  if (key == GLFW_KEY_P) state_.settings.paused = !state_.settings.paused;
  if (key == GLFW_KEY_H) state_.visible = !state_.visible;
  if (key == GLFW_KEY_F12) {
    screenshot_wanted_ = !window_.is_down(GLFW_KEY_LEFT_SHIFT) && !window_.is_down(GLFW_KEY_RIGHT_SHIFT);
  }
}

void Application::move_camera(const WindowEvents& events, double seconds) {
  constexpr double kTurn = 3.0, kFly = 0.8;  // radians over the shorter side; distances a second
  const glm::dvec2& moved = events.moved;
  if (window_.is_button_down(GLFW_MOUSE_BUTTON_LEFT)) camera_.orbit(kTurn * moved.x, -kTurn * moved.y);
  if (window_.is_button_down(GLFW_MOUSE_BUTTON_MIDDLE)) camera_.pan(moved.x, -moved.y);
  if (events.scrolled != 0) camera_.approach(events.scrolled);
  if (!window_.is_button_down(GLFW_MOUSE_BUTTON_RIGHT)) return;
  camera_.look(0.5 * kTurn * moved.x, -0.5 * kTurn * moved.y);
  const auto held = [this](int forth, int back) {
    return static_cast<double>(window_.is_down(forth)) - static_cast<double>(window_.is_down(back));
  };
  camera_.fly(
      kFly * seconds *
      glm::dvec3(held(GLFW_KEY_D, GLFW_KEY_A), held(GLFW_KEY_E, GLFW_KEY_Q), held(GLFW_KEY_W, GLFW_KEY_S)));
}

void Application::watch_files() {
  const auto now = std::chrono::steady_clock::now();
  if (now - watched_ >= kWatchTime) {
    watched_ = now;
    session_.refresh();
  }
  synchronize();
}

void Application::synchronize() {
  const TextureLayout layout = state_.settings.layout;
  try {
    renderer_.synchronize(session_, state_.settings);
  } catch (const Error& error) {
    // The other layout needs less, or what was there is shown on.
    session_.messages().fault(error.what());
    if (layout == TextureLayout::fixed_depth) state_.settings.layout = TextureLayout::two_level;
  }
}

void Application::draw(bool truth_at_once) {
  const glm::ivec2 size = arguments_.screenshot ? glm::ivec2(arguments_.width, arguments_.height)
                                                : glm::max(window_.framebuffer_size(), glm::ivec2(1));
  FrameView view;
  view.camera = camera_.camera();
  view.seconds = seconds_;
  view.width = size.x;
  view.height = size.y;
  view.light = state_.light;
  view.truth_at_once = truth_at_once;
  update_probe();
  if (state_.settings.mode == Mode::function || state_.settings.plot) view.probe = state_.probe;
  renderer_.draw(session_, state_.settings, view);

  const TruthOverlay& truth = renderer_.truth();
  state_.truth = truth.progress();
  state_.truth_ready = truth.is_ready();
  state_.error = truth.numbers();
  state_.error_top = truth.error_top();
  state_.texture_bytes = renderer_.texture_bytes();
}

void Application::draw_interface() {
  renderer_.targets().bind_output();
  if (state_.visible) interface_.draw();
}

std::optional<glm::dvec3> Application::surface_under_cursor() const {
  if (!session_.stage()) return std::nullopt;
  const glm::ivec2 size = window_.framebuffer_size();
  // Nobody points at a hidden window: its middle stands in.
  const glm::dvec2 cursor = arguments_.screenshot ? 0.5 * glm::dvec2(size) : window_.cursor();
  const CameraRays rays(camera_.camera(), static_cast<std::uint32_t>(std::max(size.x, 1)),
                        static_cast<std::uint32_t>(std::max(size.y, 1)));
  const auto point =
      session_.stage()->picture().trace(camera_.camera().eye, rays.direction(cursor.x, cursor.y));
  return point ? std::optional(point->position) : std::nullopt;
}

void Application::update_probe() {
  state_.probe.reset();
  if (state_.settings.mode != Mode::function && !state_.settings.plot) return;
  const LoadedMap* map = session_.library().of_light(state_.light);
  const bool over_panel = !arguments_.screenshot && interface_.wants_mouse();
  std::optional<glm::dvec3> point = state_.pinned;
  if (!point && !over_panel) point = surface_under_cursor();
  if (map != nullptr && point) state_.probe = probe_function(map->map, *point);
}

void Application::take_screenshot(bool with_interface) {
  screenshot_wanted_.reset();
  const std::filesystem::path name = free_screenshot_name();
  try {
    write_png(renderer_.targets().read(), name);
    session_.messages().note(name.string() + (with_interface ? "" : " (without panels)") + ": written");
  } catch (const Error& error) {
    session_.messages().fault(error.what());
  }
}

}  // namespace pdsm
