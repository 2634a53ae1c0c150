// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_textures.h"

#include <fmt/format.h>

#include <charconv>

#include "scene/format_fault.h"
#include "scene/gltf_element.h"

namespace pdsm {
namespace {

MaskWrap wrap_of(int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return MaskWrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return MaskWrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return MaskWrap::mirror;
    default:
      throw FormatFault(fmt::format("wrap mode {} is unknown", mode));
  }
}

/// A name in a URI, where "%20" stands for a space.
std::string percent_decoded(const std::string& uri) {
  std::string name;
  for (std::size_t n = 0; n < uri.size(); ++n) {
    unsigned value = 0;
    const char* const digits = uri.data() + n + 1;
    const bool coded = uri[n] == '%' && n + 2 < uri.size() &&
                       std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2;
    name += coded ? static_cast<char>(value) : uri[n];
    if (coded) n += 2;
  }
  return name;
}

std::string image_name(const tinygltf::Image& image, int index) {
  if (!image.uri.empty()) return image.uri;
  return image.name.empty() ? fmt::format("images[{}]", index) : image.name;
}

}  // namespace

GltfTexture GltfTextures::read(const tinygltf::TextureInfo& use) const {
  const tinygltf::Texture& texture = element(model_.textures, use.index, "textures");
  if (texture.source < 0) throw FormatFault("its texture has no image that can be read");
  const tinygltf::Image& image = element(model_.images, texture.source, "images");
  const std::string name = image_name(image, texture.source);
  std::array<MaskWrap, 2> wrap{};
  if (texture.sampler >= 0) {
    const tinygltf::Sampler& sampler = element(model_.samplers, texture.sampler, "samplers");
    wrap = {wrap_of(sampler.wrapS), wrap_of(sampler.wrapT)};
  }
  const GltfTexturePlaces places(use);
  try {
    return {name, image_bytes(image), wrap, places};
  } catch (const FormatFault& fault) {
    throw FormatFault(fmt::format("image {}: {}", name, fault.what()));
  }
}

std::string GltfTextures::image_bytes(const tinygltf::Image& image) const {
  if (image.bufferView >= 0) {
    const tinygltf::BufferView& view = element(model_.bufferViews, image.bufferView, "bufferViews");
    const std::vector<unsigned char>& data = element(model_.buffers, view.buffer, "buffers").data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
      throw FormatFault("reaches past its buffer");
    return {reinterpret_cast<const char*>(data.data()) + view.byteOffset, view.byteLength};
  }
  if (!image.image.empty()) return {reinterpret_cast<const char*>(image.image.data()), image.image.size()};
  if (image.uri.empty()) throw FormatFault("is empty");
  return files_.read(name_.parent_path() / percent_decoded(image.uri));
}

bool keep_image_bytes(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                      const unsigned char* bytes, int size, void*) {
  // What lies in a buffer stays there.
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

}  // namespace pdsm
