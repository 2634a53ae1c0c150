// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "scene/format_fault.h"
#include "scene/gltf_element.h"

namespace pdsm {
namespace {

/// Where an accessor's elements lie; checked against the buffer.
struct ElementRange {
  const unsigned char* first = nullptr;
  std::size_t count = 0, stride = 0;
};

/// `a` + `b`, or the largest number if that is too large.
std::size_t saturated_sum(std::size_t a, std::size_t b) {
  return a > std::numeric_limits<std::size_t>::max() - b ? std::numeric_limits<std::size_t>::max() : a + b;
}

ElementRange element_range(const tinygltf::Model& model, int index, std::size_t element_size) {
  const tinygltf::Accessor& accessor = element(model.accessors, index, "accessors");
  const auto refuse = [&](const char* what) {
    throw FormatFault(fmt::format("accessors[{}] {}", index, what));
  };
  if (accessor.sparse.isSparse) refuse("is sparse: not supported yet");
  const tinygltf::BufferView& view = element(model.bufferViews, accessor.bufferView, "bufferViews");
  const std::vector<unsigned char>& data = element(model.buffers, view.buffer, "buffers").data;
  const std::size_t stride = view.byteStride == 0 ? element_size : view.byteStride;
  if (accessor.count == 0) return {};
  if (stride < element_size || stride > 252) refuse("has a stride that does not fit its elements");
  if (accessor.count > data.size() / stride + 1) refuse("reaches past its buffer");
  const std::size_t begin = saturated_sum(view.byteOffset, accessor.byteOffset);
  const std::size_t size = (accessor.count - 1) * stride + element_size;
  if (saturated_sum(accessor.byteOffset, size) > view.byteLength) refuse("reaches past its bufferView");
  if (saturated_sum(begin, size) > data.size()) refuse("reaches past its buffer");
  return {data.data() + begin, accessor.count, stride};
}

/// Calls visit(T) with a zero of the accessor's component type.
template <typename Visit>
void with_component_type(int type, Visit&& visit) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return visit(std::int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return visit(std::uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return visit(std::int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return visit(std::uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return visit(std::uint32_t{});
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return visit(float{});
    default:
      throw FormatFault(fmt::format("component type {} is unknown", type));
  }
}

template <typename T>
float to_float(T value, bool normalized) {
  const auto plain = static_cast<float>(value);
  if (std::is_floating_point_v<T> || !normalized) return plain;
  return std::max(plain / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
}

template <typename Vector>
std::vector<Vector> read_vectors(const tinygltf::Model& model, int accessor_index, int type,
                                 const char* type_name) {
  constexpr int kAxes = Vector::length();
  const tinygltf::Accessor& accessor = element(model.accessors, accessor_index, "accessors");
  if (accessor.type != type)
    throw FormatFault(fmt::format("accessors[{}] is not {}", accessor_index, type_name));
  std::vector<Vector> vectors;
  with_component_type(accessor.componentType, [&](auto zero) {
    using T = decltype(zero);
    const ElementRange range = element_range(model, accessor_index, kAxes * sizeof(T));
    vectors.resize(range.count);
    for (std::size_t i = 0; i < range.count; ++i) {
      T values[kAxes];
      std::memcpy(values, range.first + i * range.stride, sizeof(values));
      for (int axis = 0; axis < kAxes; ++axis) vectors[i][axis] = to_float(values[axis], accessor.normalized);
    }
  });
  return vectors;
}

}  // namespace

std::vector<glm::vec3> read_positions(const tinygltf::Model& model, int accessor) {
  return read_vectors<glm::vec3>(model, accessor, TINYGLTF_TYPE_VEC3, "VEC3");
}

std::vector<glm::vec2> read_texture_places(const tinygltf::Model& model, int accessor) {
  return read_vectors<glm::vec2>(model, accessor, TINYGLTF_TYPE_VEC2, "VEC2");
}

std::vector<glm::vec4> read_rotations(const tinygltf::Model& model, int accessor) {
  return read_vectors<glm::vec4>(model, accessor, TINYGLTF_TYPE_VEC4, "VEC4");
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor_index) {
  const tinygltf::Accessor& accessor = element(model.accessors, accessor_index, "accessors");
  std::vector<std::uint32_t> indices;
  with_component_type(accessor.componentType, [&](auto zero) {
    using T = decltype(zero);
    if (!std::is_unsigned_v<T> || accessor.type != TINYGLTF_TYPE_SCALAR) {
      throw FormatFault(fmt::format("accessors[{}] does not hold indices", accessor_index));
    }
    const ElementRange range = element_range(model, accessor_index, sizeof(T));
    indices.resize(range.count);
    for (std::size_t i = 0; i < range.count; ++i) {
      T value;
      std::memcpy(&value, range.first + i * range.stride, sizeof(T));
      indices[i] = static_cast<std::uint32_t>(value);
    }
  });
  return indices;
}

}  // namespace pdsm
