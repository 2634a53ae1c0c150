// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/camera.h"
#include "settings.h"

namespace pdsm {

/// The command line.
struct Arguments {
  std::optional<std::filesystem::path> scene;
  std::vector<std::filesystem::path> maps;
  Settings settings;
  std::optional<Camera> camera;
  int width = 1280, height = 720;                   ///< pixels of the window
  std::optional<std::filesystem::path> screenshot;  ///< draw, write it, and end
  int frames = 1;                                   ///< that are drawn for a screenshot, 1/60 s each
  bool show_ui = true;
};

/// Parses the command line; nothing when help or version was wanted, which then is printed. Throws Error
/// (usage).
[[nodiscard]] std::optional<Arguments> parse_arguments(int argc, char** argv);

}  // namespace pdsm
