// SPDX-License-Identifier: Apache-2.0
#include "frame_block.h"

#include "evaluate/studio.h"

namespace pdsm {

FrameBlock make_frame_block(const CameraMatrices& matrices, const glm::vec3& eye, const Focus& focus,
                            int width, int height, bool use_footprint, double seconds) {
  FrameBlock block;
  block.world_to_clip = glm::mat4(matrices.world_to_clip);
  block.clip_to_world = glm::mat4(glm::inverse(matrices.world_to_clip));
  block.eye = glm::vec4(eye, 1);
  block.focus = glm::vec4(0, 0, 0, static_cast<float>(focus.radius));
  block.viewport = glm::vec4(width, height, matrices.pixel_size, use_footprint ? 1 : 0);
  block.sky = glm::vec4(kStudioSky, 0);
  block.bounce = glm::vec4(kStudioBounce, 0);
  block.horizon = glm::vec4(kStudioHorizon, 0);
  block.zenith = glm::vec4(kStudioZenith, static_cast<float>(kStudioZenithHeight));
  block.fade = glm::vec4(kStudioFadeBegin, kStudioFadeEnd, seconds, 0);
  return block;
}

}  // namespace pdsm
