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
/// What stood still for longer, as while a scene is read, goes on as if it had been this long.
constexpr double kLongestStep = 0.25;  // seconds
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
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
  };
  auto last = Clock::now();
  while (!window_.should_close()) {
    // Where swapping does not wait for the display, more frames than these would be for nobody.
    const WindowEvents events = window_.take_events(kFrameSeconds - since(last));
    const double seconds = since(last);
    last = Clock::now();
    state_.times.add(seconds);
    if (!events.dropped.empty()) take_files(events.dropped);
    if (!interface_.wants_keyboard()) handle_keys(events.pressed, std::min(seconds, kLongestStep));
    interface_.update(session_, state_, seconds);
    handle_buttons();
    // Only once the panels lie where they do is known whether the mouse is theirs.
    if (!interface_.wants_mouse()) handle_mouse(events.mouse);
    watch_files();
    advance(std::min(seconds, kLongestStep));
    draw(false);
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

void Application::handle_keys(const std::vector<KeyPress>& pressed, double seconds) {
  for (const KeyPress& press : pressed) handle_key(press);
  fly_camera(pressed, seconds);
}

void Application::handle_buttons() {
  if (state_.frame_scene) frame_scene();
  state_.frame_scene = false;
  if (state_.screenshot) screenshot_wanted_ = state_.screenshot;
  state_.screenshot.reset();
}

void Application::handle_mouse(const MouseEvents& mouse) {
  drag_camera(mouse);
  if (mouse.clicked && shows_function()) state_.pinned = surface_at(*mouse.clicked);
}

void Application::take_files(const std::vector<std::filesystem::path>& files) {
  const auto version = session_.stage_version();
  session_.drop(files);
  if (session_.stage_version() != version) welcome_scene();
  const MapLibrary& library = session_.library();
  if (library.of_light(state_.light) == nullptr && !library.maps().empty()) {
    state_.light = library.maps().back().light;
  }
}

void Application::handle_key(const KeyPress& press) {
  const int key = press.key;
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_6) state_.settings.mode = static_cast<Mode>(key - GLFW_KEY_1);
  if (key == GLFW_KEY_F) frame_scene();
  if (key == GLFW_KEY_P) state_.settings.paused = !state_.settings.paused;
  if (key == GLFW_KEY_H) state_.visible = !state_.visible;
  if (key == GLFW_KEY_F12) screenshot_wanted_ = !press.shift;
}

void Application::drag_camera(const MouseEvents& mouse) {
  constexpr double kTurn = 3.0;  // radians over the shorter side
  const glm::ivec2 size = window_.framebuffer_size();
  const double shorter = std::max(1, std::min(size.x, size.y));
  const auto way = [&](MouseButton button) { return mouse.drag(button) / shorter; };
  const glm::dvec2 orbit = way(MouseButton::left), pan = way(MouseButton::middle);
  const glm::dvec2 look = way(MouseButton::right);
  if (orbit != glm::dvec2(0)) camera_.orbit(kTurn * orbit.x, -kTurn * orbit.y);
  if (pan != glm::dvec2(0)) camera_.pan(pan.x, -pan.y);
  if (look != glm::dvec2(0)) camera_.look(0.5 * kTurn * look.x, -0.5 * kTurn * look.y);
  if (mouse.scrolled != 0) camera_.approach(mouse.scrolled);
}

void Application::fly_camera(const std::vector<KeyPress>& pressed, double seconds) {
  constexpr double kFly = 0.8;  // distances to the target a second
  // A tap may be shorter than a frame.
  const auto held = [&](int key) {
    return window_.is_down(key) ||
           std::any_of(pressed.begin(), pressed.end(), [key](const KeyPress& p) { return p.key == key; });
  };
  const auto along = [&](int forth, int back) { return static_cast<double>(held(forth)) - held(back); };
  const glm::dvec3 way(along(GLFW_KEY_D, GLFW_KEY_A), along(GLFW_KEY_E, GLFW_KEY_Q),
                       along(GLFW_KEY_W, GLFW_KEY_S));
  if (way != glm::dvec3(0)) camera_.fly(kFly * seconds * way);
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
  view.probe = state_.probe;
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
  interface_.draw();
}

std::optional<glm::dvec3> Application::surface_under_cursor() const {
  // Nobody points at a hidden window: its middle stands in.
  return surface_at(arguments_.screenshot ? 0.5 * glm::dvec2(window_.framebuffer_size()) : window_.cursor());
}

std::optional<glm::dvec3> Application::surface_at(const glm::dvec2& place) const {
  if (!session_.stage()) return std::nullopt;
  const glm::ivec2 size = glm::max(window_.framebuffer_size(), glm::ivec2(1));
  const CameraRays rays(camera_.camera(), static_cast<std::uint32_t>(size.x),
                        static_cast<std::uint32_t>(size.y));
  const auto point =
      session_.stage()->picture().trace(camera_.camera().eye, rays.direction(place.x, place.y));
  return point ? std::optional(point->position) : std::nullopt;
}

bool Application::shows_function() const {
  return state_.settings.mode == Mode::function || state_.settings.plot;
}

void Application::update_probe() {
  state_.probe.reset();
  if (!shows_function()) return;
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
