// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "scene/tiny_gltf.h"

namespace pdsm {

/// Where the corners of primitives lie in a texture: which set of coordinates, and KHR_texture_transform.
class GltfTexturePlaces {
 public:
  /// Throws FormatFault when the transform is none.
  explicit GltfTexturePlaces(const tinygltf::TextureInfo& texture);

  /// The places of a primitive's `count` corners. Throws FormatFault when it has not just as many.
  [[nodiscard]] std::vector<glm::vec2> read(const tinygltf::Model& model,
                                            const tinygltf::Primitive& primitive, std::size_t count) const;

  friend bool operator==(const GltfTexturePlaces&, const GltfTexturePlaces&) = default;

 private:
  int set_;
  glm::dmat2 turn_{1.0};
  glm::dvec2 offset_{0};
};

}  // namespace pdsm
