// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "gl_objects.h"
#include "shader_program.h"
#include "stage.h"
#include "surface_mesh.h"

namespace pdsm {

/// A mesh in buffers of the GL.
class GpuMesh {
 public:
  GpuMesh() = default;
  explicit GpuMesh(const SurfaceMesh& mesh);
  void draw() const;

 private:
  GlVertexArray array_;
  GlBuffer vertices_, indices_;
  GLsizei index_count_ = 0;
};

/// All geometry of a scene.
class SceneMeshes {
 public:
  SceneMeshes() = default;
  explicit SceneMeshes(const Stage& stage);

  /// Draws everything, what is near `eye` (metres from the origin) first. `program` has to be in use.
  void draw(const ShaderProgram& program, const glm::vec3& eye) const;

 private:
  struct Part {
    GpuMesh mesh;
    glm::vec3 colour{1}, low{0}, high{0};
  };
  std::vector<Part> parts_;
};

}  // namespace pdsm
