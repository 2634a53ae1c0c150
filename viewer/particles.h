// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "evaluate/focus.h"
#include "gl_objects.h"
#include "shader_program.h"

namespace pdsm {

/// Motes of dust that drift around the focus, each lit by the maps at its place.
class Particles {
 public:
  Particles() : array_(GlVertexArray::make()) {}
  /// Draws over a picture whose depth is bound; the frame's blocks tell time and lights.
  void draw(const ShaderProgram& program, const Focus& focus) const;

 private:
  GlVertexArray array_;  // empty: the program makes its own vertices
};

}  // namespace pdsm
