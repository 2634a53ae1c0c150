// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_texture_places.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/format_fault.h"
#include "scene/gltf_accessor.h"

namespace pdsm {
namespace {

constexpr const char* kTransform = "KHR_texture_transform";

double number(const tinygltf::Value& value, const char* key) {
  if (!value.IsNumber()) throw FormatFault(fmt::format("{}: {} is not a number", kTransform, key));
  return value.GetNumberAsDouble();
}

glm::dvec2 pair(const tinygltf::Value& transform, const char* key, const glm::dvec2& otherwise) {
  if (!transform.Has(key)) return otherwise;
  const tinygltf::Value& value = transform.Get(key);
  if (!value.IsArray() || value.ArrayLen() != 2)
    throw FormatFault(fmt::format("{}: {} is not a pair of numbers", kTransform, key));
  return {number(value.Get(0), key), number(value.Get(1), key)};
}

}  // namespace

GltfTexturePlaces::GltfTexturePlaces(const tinygltf::TextureInfo& texture) : set_(texture.texCoord) {
  const auto found = texture.extensions.find(kTransform);
  if (found == texture.extensions.end()) return;
  const tinygltf::Value& transform = found->second;
  if (transform.Has("texCoord")) set_ = static_cast<int>(number(transform.Get("texCoord"), "texCoord"));
  const double angle = transform.Has("rotation") ? number(transform.Get("rotation"), "rotation") : 0;
  const glm::dvec2 scale = pair(transform, "scale", {1, 1});
  offset_ = pair(transform, "offset", {0, 0});
  // Counter-clockwise as one looks at the image, whose v points down. The extension's sample code turns the
  // other way; its test model and its implementations do not.
  const double c = std::cos(angle), s = std::sin(angle);
  turn_ = {scale.x * c, -scale.x * s, scale.y * s, scale.y * c};
}

std::vector<glm::vec2> GltfTexturePlaces::read(const tinygltf::Model& model,
                                               const tinygltf::Primitive& primitive,
                                               std::size_t count) const {
  const std::string name = fmt::format("TEXCOORD_{}", set_);
  const auto attribute = primitive.attributes.find(name);
  if (attribute == primitive.attributes.end()) throw FormatFault("a primitive has no " + name);
  std::vector<glm::vec2> places = read_texture_places(model, attribute->second);
  if (places.size() != count)
    throw FormatFault(fmt::format("a primitive has {} {} for {} positions", places.size(), name, count));
  for (glm::vec2& place : places) place = glm::vec2(turn_ * glm::dvec2(place) + offset_);
  return places;
}

}  // namespace pdsm
