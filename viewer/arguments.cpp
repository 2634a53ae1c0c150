// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/command_line.h"
#include "cli/parse_camera.h"
#include "evaluate/image_io.h"
#include "pdsm/format/error.h"
#include "session.h"

namespace pdsm {
namespace {

constexpr int kMostFrames = 1'000'000;
constexpr std::uint32_t kSmallestEdge = 16, kLargestEdge = 16384;

/// What the command line says before it is checked.
struct RawArguments {
  std::vector<std::string> files;
  std::string screenshot;
  bool no_ui = false;
  Arguments parsed;
  std::optional<std::uint32_t> frames;
};

struct ShowWord {
  const char* word;
  bool Settings::*setting;
};
constexpr ShowWord kShowWords[] = {{"object", &Settings::object},   {"particles", &Settings::particles},
                                   {"fog", &Settings::fog},         {"gizmos", &Settings::gizmos},
                                   {"frustum", &Settings::frustum}, {"plot", &Settings::plot}};

/// --show: exactly what the list names.
void choose_shown(const std::string& list, Settings& settings) {
  for (const ShowWord& shown : kShowWords) settings.*shown.setting = false;
  if (list == "none") return;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string word = list.substr(begin, end - begin);
    const auto* found = std::find_if(std::begin(kShowWords), std::end(kShowWords),
                                     [&word](const ShowWord& shown) { return shown.word == word; });
    if (found == std::end(kShowWords)) {
      refuse_value("--show", "none, or a list of object,particles,fog,gizmos,frustum,plot", list);
    }
    settings.*found->setting = true;
    begin = end + 1;
  }
}

void add_picture_options(Options takes, RawArguments& raw) {
  Arguments& parsed = raw.parsed;
  takes.value(
      "--camera", "EX,EY,EZ,TX,TY,TZ,FOV",
      [&parsed](const std::string& text) { parsed.camera = parse_camera(text); },
      "As pdsm render; default: a three-quarter view of the casters");
  takes.value(
      "--size", "WxH",
      [&parsed](const std::string& text) {
        const auto size = parse_size("--size", text, kLargestEdge);
        if (std::min(size[0], size[1]) < kSmallestEdge) refuse_value("--size", "at least 16x16", text);
        parsed.width = static_cast<int>(size[0]);
        parsed.height = static_cast<int>(size[1]);
      },
      "Pixels of the window; default 1280x720");
  takes.text("--screenshot", "FILE.png", raw.screenshot,
             "Draw without a visible window, write this picture and end");
  takes.count("--frames", raw.frames, 1, kMostFrames, "Frames of 1/60 s before the screenshot; default 1");
  takes.flag("--no-ui", raw.no_ui, "No panels in the screenshot");
}

void add_view_options(Options takes, RawArguments& raw) {
  Settings& settings = raw.parsed.settings;
  takes.choice<Mode>("--mode", settings.mode,
                     {{"shaded", Mode::shaded},
                      {"visibility", Mode::visibility},
                      {"truth", Mode::truth},
                      {"error", Mode::error},
                      {"slice", Mode::slice},
                      {"function", Mode::function}},
                     "What is shown at first; keys 1 to 6");
  takes.choice<Filter>("--filter", settings.filter,
                       {{"nearest", Filter::nearest}, {"bilinear", Filter::bilinear}}, "Default bilinear");
  takes.choice<TextureLayout>(
      "--layout", settings.layout,
      {{"two-level", TextureLayout::two_level}, {"fixed-depth", TextureLayout::fixed_depth}},
      "How the maps lie in textures; default two-level");
  takes.value(
      "--show", "LIST", [&settings](const std::string& list) { choose_shown(list, settings); },
      "none, or some of object,particles,fog,gizmos,frustum,plot; default object,particles,gizmos");
}

void take_files(const std::vector<std::string>& files, Arguments& arguments) {
  const SortedFiles sorted = sort_files({files.begin(), files.end()});
  if (sorted.scenes.size() > 1) {
    throw Error(Failure::usage, sorted.scenes[1].string(), "is a second scene");
  }
  if (!sorted.scenes.empty()) arguments.scene = sorted.scenes.front();
  arguments.maps = sorted.maps;
}

/// Options that need one another.
Arguments checked(const RawArguments& raw) {
  Arguments arguments = raw.parsed;
  take_files(raw.files, arguments);
  arguments.show_ui = !raw.no_ui;
  if (!arguments.scene && !arguments.maps.empty()) {
    throw Error(Failure::usage, arguments.maps.front().string(), "needs the scene that it was baked from");
  }
  if (raw.screenshot.empty()) {
    if (raw.frames) throw Error(Failure::usage, "--frames", "needs --screenshot");
    if (raw.no_ui) throw Error(Failure::usage, "--no-ui", "needs --screenshot");
    return arguments;
  }
  if (!arguments.scene) throw Error(Failure::usage, "--screenshot", "needs a scene");
  if (image_format(raw.screenshot, "--screenshot") != ImageFormat::png) {
    throw Error(Failure::usage, "--screenshot", "must end in .png, not '" + raw.screenshot + "'");
  }
  arguments.screenshot = raw.screenshot;
  arguments.frames = static_cast<int>(raw.frames.value_or(1));
  return arguments;
}

}  // namespace

std::optional<Arguments> parse_arguments(int argc, char** argv) {
  CommandLine line(
      "pdsm-viewer", "Shows what was baked, what moves through it, and how far it is from the truth.",
      "pdsm-viewer " PDSM_VERSION,
      "Left drag orbits, middle drag pans, the wheel zooms; right drag looks, WASD and QE fly; F frames the "
      "scene,\n"
      "1 to 6 choose the mode, a click pins the function, P pauses, F12 takes a screenshot (with Shift: "
      "without\n"
      "panels), H hides the panels.\n"
      "Exit codes: 0 ok, 2 usage, 3 bad input, 4 output or resource.");
  RawArguments raw;
  Options takes = line.options();
  takes.texts("FILE", "", raw.files,
              "A scene, and maps of its lights, in any order; or drop them on the window");
  add_view_options(takes, raw);
  add_picture_options(takes, raw);
  if (!line.parse(argc, argv)) return std::nullopt;
  return checked(raw);
}

}  // namespace pdsm
