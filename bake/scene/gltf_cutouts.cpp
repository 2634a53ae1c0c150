// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_cutouts.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "pdsm/format/error.h"
#include "scene/alpha_image.h"
#include "scene/format_fault.h"
#include "scene/glass_image.h"
#include "scene/gltf_element.h"
#include "scene/gltf_texture_places.h"
#include "scene/one_line.h"

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

constexpr const char *kBlend = "BLEND", *kMask = "MASK";

bool is_share(double x) {
  return x >= 0 && x <= 1;
}

/// Linear colour and alpha.
glm::dvec4 base_factor(const tinygltf::Material& material) {
  const std::vector<double>& factor = material.pbrMetallicRoughness.baseColorFactor;
  if (factor.size() != 4) return glm::dvec4(1);
  if (!std::ranges::all_of(factor, is_share)) throw FormatFault("baseColorFactor must be from 0 to 1");
  return {factor[0], factor[1], factor[2], factor[3]};
}

constexpr const char* kTransmission = "KHR_materials_transmission";

/// Share of light that a material lets through before its colour takes of it.
double transmission_factor(const tinygltf::Material& material) {
  const auto extension = material.extensions.find(kTransmission);
  if (extension == material.extensions.end() || !extension->second.Has("transmissionFactor")) return 0;
  const tinygltf::Value& factor = extension->second.Get("transmissionFactor");
  if (!factor.IsNumber() || !is_share(factor.GetNumberAsDouble()))
    throw FormatFault("transmissionFactor must be from 0 to 1");
  return factor.GetNumberAsDouble();
}

/// Alpha times the factor's is at least the file's cutoff where alpha is at least this.
double alpha_cutoff(const tinygltf::Material& material) {
  const double opacity = base_factor(material).a;
  if (opacity > 0) return material.alphaCutoff / opacity;
  return material.alphaCutoff > 0 ? HUGE_VAL : 0;
}

bool has_transmission_texture(const tinygltf::Material& material) {
  const auto extension = material.extensions.find(kTransmission);
  return extension != material.extensions.end() && extension->second.Has("transmissionTexture");
}

}  // namespace

struct GltfCutouts::Cutout {
  std::shared_ptr<const CutoutMask> mask;   // null: nothing is cut out
  std::optional<GltfTexturePlaces> places;  // none: the mask is the same everywhere
};

void GltfCutouts::cut_out(const tinygltf::Primitive& primitive, Mesh& mesh) {
  const tinygltf::Material* found = find_element(model_.materials, primitive.material);
  if (found == nullptr) return;
  const auto material = static_cast<std::size_t>(primitive.material);
  const std::string& mode = found->alphaMode;
  if (mesh.positions.empty()) return;
  try {
    if (mode != kMask && mode != kBlend && transmission_factor(*found) == 0) return;
    const Cutout& cutout = cutout_of(material);
    if (!cutout.mask) return;
    mesh.mask = cutout.mask;
    if (cutout.places)
      mesh.mask_places = cutout.places->read(model_, primitive, mesh.positions.size());
    else
      mesh.mask_places.assign(mesh.positions.size(), glm::vec2(0));
  } catch (const std::exception& fault) {
    throw Error(Failure::input, name_.string() + ":" + name_of(material), one_line(fault.what()));
  }
}

Translucency GltfCutouts::translucency(int index) {
  const tinygltf::Material* material = find_element(model_.materials, index);
  if (material == nullptr) return {};
  const std::string name = name_of(static_cast<std::size_t>(index));
  try {
    const glm::dvec4 factor = base_factor(*material);
    const double transmission = transmission_factor(*material);
    if (transmission > 0 && has_transmission_texture(*material))
      parts_.warn(name + ": transmissionTexture is not read: transmissionFactor holds everywhere");
    return {material->alphaMode == kBlend ? factor.a : 1, transmission * glm::dvec3(factor)};
  } catch (const FormatFault& fault) {
    throw Error(Failure::input, name_.string() + ":" + name, one_line(fault.what()));
  }
}

const GltfCutouts::Cutout& GltfCutouts::cutout_of(std::size_t material) {
  auto& cutout = cutouts_[material];
  if (!cutout)
    cutout = std::make_shared<const Cutout>(read_cutout(model_.materials[material], name_of(material)));
  return *cutout;
}

GltfCutouts::Cutout GltfCutouts::read_cutout(const tinygltf::Material& material, const std::string& where) {
  if (!(material.alphaCutoff >= 0)) throw FormatFault("alphaCutoff must be 0 or more");
  if (material.pbrMetallicRoughness.baseColorTexture.index >= 0) return read_picture_cutout(material, where);
  if (material.alphaMode != kMask) return {};
  return {make_mask({1, 1, {255}, true}, {}, alpha_cutoff(material)), {}};
}

GltfCutouts::Cutout GltfCutouts::read_picture_cutout(const tinygltf::Material& material,
                                                     const std::string& where) {
  const tinygltf::TextureInfo& base = material.pbrMetallicRoughness.baseColorTexture;
  const tinygltf::Texture& texture = element(model_.textures, base.index, "textures");
  if (texture.source < 0) throw FormatFault("its texture has no image that can be read");
  const tinygltf::Image& image = element(model_.images, texture.source, "images");
  const std::string name = image_name(image, texture.source);
  const GltfTexturePlaces places(base);
  std::array<MaskWrap, 2> wrap{};
  if (texture.sampler >= 0) {
    const tinygltf::Sampler& sampler = element(model_.samplers, texture.sampler, "samplers");
    wrap = {wrap_of(sampler.wrapS), wrap_of(sampler.wrapT)};
  }
  const bool blends = material.alphaMode == kBlend, has_cutoff = material.alphaMode == kMask;
  const double cutoff = alpha_cutoff(material);
  try {
    const std::string bytes = image_bytes(image);
    if (transmission_factor(material) > 0) {
      const GlassAlpha alpha = blends ? GlassAlpha::blends : has_cutoff ? GlassAlpha::cuts : GlassAlpha::none;
      return {read_glass(bytes, wrap, alpha, cutoff), places};
    }
    AlphaImage alpha = read_alpha(bytes, WithoutAlpha::opaque);
    if (blends) return {make_blend(std::move(alpha), wrap), places};
    if (!alpha.has_alpha)
      parts_.warn(fmt::format("{}: image {} has no alpha channel: nothing is cut out", where, name));
    return {make_mask(std::move(alpha), wrap, cutoff), places};
  } catch (const FormatFault& fault) {
    throw FormatFault(fmt::format("image {}: {}", name, fault.what()));
  }
}

std::string GltfCutouts::image_bytes(const tinygltf::Image& image) {
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

std::string GltfCutouts::name_of(std::size_t material) const {
  const std::string& name = model_.materials[material].name;
  return name.empty() ? fmt::format("materials[{}]", material) : name;
}

bool keep_image_bytes(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                      const unsigned char* bytes, int size, void*) {
  // What lies in a buffer stays there.
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

}  // namespace pdsm
