// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "camera_control.h"
#include "evaluate/focus.h"

namespace pdsm {

/// The uniform block ViewerFrame, as shaders/frame.glsl declares it (std140).
struct FrameBlock {
  glm::mat4 world_to_clip{1}, clip_to_world{1};
  glm::vec4 eye{0}, focus{0}, viewport{0}, sky{0}, bounce{0}, horizon{0}, zenith{0}, fade{0};
};

/// `eye`: metres from the origin, where the focus' centre is.
[[nodiscard]] FrameBlock make_frame_block(const CameraMatrices& matrices, const glm::vec3& eye,
                                          const Focus& focus, int width, int height, bool use_footprint,
                                          double seconds);

}  // namespace pdsm
