// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "evaluate/camera.h"
#include "function_probe.h"
#include "session.h"
#include "settings.h"

namespace pdsm {

/// What a frame shows besides the session and the settings.
struct FrameView {
  Camera camera;
  double seconds = 0;         ///< of the moving things' time
  int width = 1, height = 1;  ///< pixels
  std::size_t light = 0;      ///< index in the scene of the light that slices are cut from
  std::optional<FunctionProbe> probe;
  bool truth_at_once = false;  ///< do not wait for the picture to stand still
};

/// What drawing made of it.
struct FrameState {
  glm::dmat4 world_to_clip{1};
  glm::mat4 object{1};  ///< how the moving object lies
  std::uint64_t truth_version = 0;
};

/// What a picture depends on. While all of it stays, pictures add up to a smoother one; while that of what
/// does not move stays, this is drawn once.
struct PictureKey {
  Settings settings;
  std::vector<LightControl> lights;
  std::uint64_t stage_version = 0, map_version = 0, truth_version = 0;
  glm::dmat4 world_to_clip{1};
  int width = 0, height = 0;
  glm::mat4 object{1};
  double seconds = 0;
  std::size_t light = 0;
  std::optional<std::array<double, 3>> probe;  ///< texel and depth

  friend bool operator==(const PictureKey&, const PictureKey&) = default;
};

/// What the picture of a frame depends on.
[[nodiscard]] PictureKey picture_key(const Session& session, const Settings& settings, const FrameView& view,
                                     const FrameState& state);

/// What its part depends on that does not move; `with_object`: which the object belongs to.
[[nodiscard]] PictureKey still_key(const Session& session, const Settings& settings, const FrameView& view,
                                   const FrameState& state, bool with_object);

}  // namespace pdsm
