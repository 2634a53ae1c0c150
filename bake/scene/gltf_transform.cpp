// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_transform.h"

#include <cmath>
#include <numeric>
#include <string>

#include "scene/format_fault.h"
#include "scene/gltf_accessor.h"

namespace pdsm {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

glm::dmat4 rotation_matrix(const std::vector<double>& quaternion) {
  const double length =
      std::sqrt(std::inner_product(quaternion.begin(), quaternion.end(), quaternion.begin(), 0.0));
  if (!(length > 0)) return glm::dmat4(1.0);
  const double x = quaternion[0] / length, y = quaternion[1] / length, z = quaternion[2] / length,
               w = quaternion[3] / length;
  return {1 - 2 * (y * y + z * z),
          2 * (x * y + z * w),
          2 * (x * z - y * w),
          0,
          2 * (x * y - z * w),
          1 - 2 * (x * x + z * z),
          2 * (y * z + x * w),
          0,
          2 * (x * z + y * w),
          2 * (y * z - x * w),
          1 - 2 * (x * x + y * y),
          0,
          0,
          0,
          0,
          1};
}

/// Scales, then turns, then moves.
glm::dmat4 compose(const glm::dvec3& translation, const glm::dmat4& rotation, const glm::dvec3& scale) {
  glm::dmat4 m = rotation;
  for (int axis = 0; axis < 3; ++axis) m[axis] *= scale[axis];
  m[3] = glm::dvec4(translation, 1.0);
  return m;
}

/// The accessor of an attribute of instances; below 0 where there is none.
int instance_accessor(const tinygltf::Value& attributes, const char* name) {
  if (!attributes.Has(name)) return -1;
  const tinygltf::Value& index = attributes.Get(name);
  if (!index.IsInt() || index.GetNumberAsInt() < 0)
    throw FormatFault(std::string(kInstancing) + " has an attribute that is no accessor");
  return index.GetNumberAsInt();
}

/// All attributes of instances have as many elements.
template <typename Vector>
void check_count(const std::vector<Vector>& values, std::size_t& count) {
  if (values.empty()) return;
  if (count != 0 && values.size() != count)
    throw FormatFault(std::string(kInstancing) + " has attributes of different lengths");
  count = values.size();
}

}  // namespace

glm::dmat4 node_matrix(const tinygltf::Node& node) {
  glm::dmat4 m(1.0);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    return m;
  }
  const auto vector = [](const std::vector<double>& values, const glm::dvec3& otherwise) {
    return values.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : otherwise;
  };
  if (node.rotation.size() == 4) m = rotation_matrix(node.rotation);
  return compose(vector(node.translation, glm::dvec3(0)), m, vector(node.scale, glm::dvec3(1)));
}

std::vector<glm::dmat4> instance_matrices(const tinygltf::Model& model, const tinygltf::Node& node) {
  const auto extension = node.extensions.find(kInstancing);
  if (extension == node.extensions.end()) return {glm::dmat4(1.0)};
  if (!extension->second.Has("attributes"))
    throw FormatFault(std::string(kInstancing) + " has no attributes");
  const tinygltf::Value& attributes = extension->second.Get("attributes");
  const int translation = instance_accessor(attributes, "TRANSLATION"),
            rotation = instance_accessor(attributes, "ROTATION"),
            scale = instance_accessor(attributes, "SCALE");
  std::vector<glm::vec3> translations, scales;
  std::vector<glm::vec4> rotations;
  if (translation >= 0) translations = read_positions(model, translation);
  if (rotation >= 0) rotations = read_rotations(model, rotation);
  if (scale >= 0) scales = read_positions(model, scale);
  std::size_t count = 0;
  check_count(translations, count);
  check_count(rotations, count);
  check_count(scales, count);
  std::vector<glm::dmat4> matrices;
  for (std::size_t n = 0; n < count; ++n) {
    glm::dmat4 rotation_of(1.0);
    if (!rotations.empty()) {
      const glm::dvec4 q(rotations[n]);
      rotation_of = rotation_matrix({q.x, q.y, q.z, q.w});
    }
    matrices.push_back(compose(translations.empty() ? glm::dvec3(0) : glm::dvec3(translations[n]),
                               rotation_of, scales.empty() ? glm::dvec3(1) : glm::dvec3(scales[n])));
  }
  return matrices;
}

}  // namespace pdsm
