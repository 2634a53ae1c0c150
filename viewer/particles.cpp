// SPDX-License-Identifier: Apache-2.0
#include "particles.h"

namespace pdsm {

void Particles::draw(const ShaderProgram& program, const Focus& focus) const {
  constexpr GLsizei kCount = 350;
  constexpr double kSpread = 1.25, kSize = 0.0075;  // radii of the focus
  program.use();
  program.set("spread", static_cast<float>(kSpread * focus.radius));
  program.set("size", static_cast<float>(kSize * focus.radius));
  glBindVertexArray(array_.name());
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, kCount);
  glDisable(GL_BLEND);
}

}  // namespace pdsm
