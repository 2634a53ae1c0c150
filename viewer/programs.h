// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "shader_program.h"

namespace pdsm {

/// Texture units; the maps' two textures come first.
enum TextureUnit : GLuint {
  kMapUnit = 0,
  kPositionUnit = 2,
  kNormalUnit,
  kColourUnit,
  kDepthUnit,
  kPictureUnit,
  kFogUnit,
  kTruthUnit,
  kErrorUnit,
  kHeatUnit
};

/// All programs of the viewer.
struct Programs {
  ShaderProgram surface;                           ///< meshes to what pixels are shaded from
  ShaderProgram shaded, visibility, truth, error;  ///< pixels, as the modes show them
  ShaderProgram object_shaded, object_visibility;  ///< meshes at once, as the modes show them
  ShaderProgram capture, line, slice, particle, fog, fog_composite, smooth, copy;
};

/// Builds them around ShadowTextures::shader_text(), anew when the layout of the maps has changed. Throws
/// Error (resource).
[[nodiscard]] Programs make_programs(const std::string& shadow_text);

}  // namespace pdsm
