// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/tiny_gltf.h"

namespace pdsm {

/// A node's space to its parent's.
[[nodiscard]] glm::dmat4 node_matrix(const tinygltf::Node& node);

/// Where a node has its mesh, in its own space: once, or at each place that EXT_mesh_gpu_instancing tells.
/// Throws FormatFault.
[[nodiscard]] std::vector<glm::dmat4> instance_matrices(const tinygltf::Model& model,
                                                        const tinygltf::Node& node);

}  // namespace pdsm
