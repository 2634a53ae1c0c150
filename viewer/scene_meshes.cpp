// SPDX-License-Identifier: Apache-2.0
#include "scene_meshes.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace pdsm {
namespace {

template <typename Element>
void fill_buffer(GLenum target, const GlBuffer& buffer, const std::vector<Element>& elements) {
  glBindBuffer(target, buffer.name());
  glBufferData(target, static_cast<GLsizeiptr>(sizeof(Element) * elements.size()), elements.data(),
               GL_STATIC_DRAW);
}

}  // namespace

GpuMesh::GpuMesh(const SurfaceMesh& mesh)
    : array_(GlVertexArray::make()),
      vertices_(GlBuffer::make()),
      indices_(GlBuffer::make()),
      index_count_(static_cast<GLsizei>(mesh.indices.size())) {
  glBindVertexArray(array_.name());
  fill_buffer(GL_ARRAY_BUFFER, vertices_, mesh.vertices);
  fill_buffer(GL_ELEMENT_ARRAY_BUFFER, indices_, mesh.indices);
  const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(SurfaceVertex), offset(0));
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 4, GL_INT_2_10_10_10_REV, GL_TRUE, sizeof(SurfaceVertex),
                        offset(offsetof(SurfaceVertex, normal)));
  glBindVertexArray(0);
}

void GpuMesh::draw() const {
  glBindVertexArray(array_.name());
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

SceneMeshes::SceneMeshes(const Stage& stage) {
  for (const Geometry& geometry : stage.scene().geometry) {
    const SurfaceMesh mesh = make_surface_mesh(geometry, stage.origin());
    if (mesh.indices.empty()) continue;
    Part part{GpuMesh(mesh), geometry.base_color, glm::vec3(std::numeric_limits<float>::max()),
              glm::vec3(std::numeric_limits<float>::lowest())};
    for (const SurfaceVertex& vertex : mesh.vertices) {
      part.low = glm::min(part.low, vertex.position);
      part.high = glm::max(part.high, vertex.position);
    }
    parts_.push_back(std::move(part));
  }
}

void SceneMeshes::draw(const ShaderProgram& program, const glm::vec3& eye) const {
  // Ground and walls come last: most of them is hidden, and then need not be shaded.
  const auto distance = [&eye](const Part* part) {
    const glm::vec3 centre = 0.5F * (part->low + part->high);
    return glm::distance(centre, eye) + glm::distance(part->low, part->high);
  };
  std::vector<const Part*> order;
  for (const Part& part : parts_) order.push_back(&part);
  std::sort(order.begin(), order.end(),
            [&](const Part* a, const Part* b) { return distance(a) < distance(b); });
  program.set("model", glm::mat4(1));
  for (const Part* part : order) {
    program.set("base_colour", part->colour);
    part->mesh.draw();
  }
}

}  // namespace pdsm
