// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "evaluate/studio.h"
#include "gl_objects.h"
#include "map_library.h"
#include "stage.h"

namespace pdsm {

/// What a person can change of a light; its bake does not depend on it.
struct LightControl {
  bool on = true;
  float intensity = 1;
  glm::vec3 colour{1};  ///< linear RGB, times the studio's

  friend bool operator==(const LightControl&, const LightControl&) = default;
};

/// A light that is on, as the programs see it. Light n of a frame is number n in the shaders.
struct ShownLight {
  std::size_t light = 0;  ///< index in the scene
  int map = -1;           ///< index in the library, -1 without a map
  StudioLight studio;     ///< world space
  glm::vec3 radiance{1};  ///< with what was changed
};

/// Most lights that are shown at once.
inline constexpr std::size_t kMostLights = 64;

/// Controls for a scene's lights as they are at first: those with maps are on, or all when there is no map.
[[nodiscard]] std::vector<LightControl> initial_lights(const Stage& stage, const MapLibrary& library);

/// The lights that are on, in the order of the scene.
[[nodiscard]] std::vector<ShownLight> shown_lights(const Stage& stage, const MapLibrary& library,
                                                   const std::vector<LightControl>& controls);

/// The uniform block ViewerLights. Needs the GL.
class LightBlock {
 public:
  LightBlock();
  /// Uploads the lights and binds the block.
  void update(const std::vector<ShownLight>& lights, const Stage& stage);

 private:
  GlBuffer buffer_;
};

}  // namespace pdsm
