// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "frame_targets.h"
#include "gl_objects.h"
#include "programs.h"
#include "settings.h"
#include "stage.h"

namespace pdsm {

/// A slab of fog around the focus, marched at a fraction of the picture's size.
class Fog {
 public:
  /// Draws over the targets' picture, whose depth is bound, and leaves it bound.
  void draw(const Programs& programs, const FrameTargets& targets, const Stage& stage,
            const Settings& settings);

 private:
  void resize(int width, int height);

  int width_ = 0, height_ = 0;
  GlTexture picture_;
  GlFramebuffer target_;
};

}  // namespace pdsm
