// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/tiny_gltf.h"

namespace pdsm {

/// The positions of a VEC3 accessor (float, or normalised or plain 8- and 16-bit integers as in
/// KHR_mesh_quantization). Throws FormatFault when it does not lie within its buffer.
[[nodiscard]] std::vector<glm::vec3> read_positions(const tinygltf::Model& model, int accessor);

/// The places of a VEC2 accessor, of the same types. Same faults.
[[nodiscard]] std::vector<glm::vec2> read_texture_places(const tinygltf::Model& model, int accessor);

/// The quaternions (x, y, z, w) of a VEC4 accessor, of the same types. Same faults.
[[nodiscard]] std::vector<glm::vec4> read_rotations(const tinygltf::Model& model, int accessor);

/// The indices of a SCALAR accessor of unsigned integers. Same faults.
[[nodiscard]] std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor);

}  // namespace pdsm
