// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "evaluate/render.h"
#include "function_probe.h"
#include "settings.h"
#include "truth_job.h"

namespace pdsm {

/// The last frames' times, milliseconds.
struct FrameTimes {
  static constexpr std::size_t kCount = 120;
  std::array<float, kCount> milliseconds{};
  std::size_t next = 0, filled = 0;

  void add(double seconds);
  /// Of most frames: a single slow one does not count. Milliseconds.
  [[nodiscard]] float median() const;
};

/// What the panels show and change.
struct UiState {
  Settings settings;
  bool visible = true;
  std::size_t light = 0;  ///< that slices, plots and facts are of; index in the scene

  std::optional<glm::dvec3> pinned;    ///< point whose function is shown, world, metres
  std::optional<FunctionProbe> probe;  ///< of that point, or of the one under the cursor

  TruthProgress truth;
  DifferenceSummary error;
  float error_top = 0;
  bool truth_ready = false;

  FrameTimes times;
  std::uint64_t texture_bytes = 0;

  // What was asked for by a button; the application takes it back.
  bool frame_scene = false;
  std::optional<bool> screenshot;  ///< with the panels or without
};

}  // namespace pdsm
