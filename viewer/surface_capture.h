// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "frame_targets.h"
#include "shader_program.h"

namespace pdsm {

/// The visible surfaces of a picture, pixel by pixel, row 0 at the bottom.
struct CapturedSurfaces {
  int width = 0, height = 0;
  /// Metres from the origin; w = 0 where there is no surface.
  std::vector<glm::vec4> positions;
  /// Of each light: attenuation by its map (-1 without one), and 1 where the light shines on the surface.
  std::vector<std::vector<glm::vec2>> look_ups;
};

/// Reads back the targets' surfaces, and what the capture program says of the first `lights` lights on them;
/// waits for the GL. The frame's blocks, the maps and the surfaces have to be bound. Throws Error (resource).
[[nodiscard]] CapturedSurfaces capture_surfaces(const ShaderProgram& program, const FrameTargets& targets,
                                                int lights);

}  // namespace pdsm
