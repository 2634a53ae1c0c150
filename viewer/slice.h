// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gl_objects.h"
#include "pdsm/format/penumbra_map.h"
#include "settings.h"
#include "shader_program.h"
#include "stage.h"

namespace pdsm {

/// A plane through a map's attenuation, drawn over the scene: in heat colours, faint where something hides
/// it.
class Slice {
 public:
  Slice() : array_(GlVertexArray::make()) {}
  /// `index`: number of the map in the shader. Needs heat colours in their unit.
  void draw(const ShaderProgram& program, const Stage& stage, const PenumbraMap& map, int index,
            const Settings& settings) const;

 private:
  GlVertexArray array_;
};

/// Where the plane of the settings is: metres, along its world axis or the light's direction.
[[nodiscard]] double slice_place(const Stage& stage, const View& view, const Settings& settings);

}  // namespace pdsm
