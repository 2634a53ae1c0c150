// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_cutouts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "pdsm/format/error.h"
#include "scene/alpha_image.h"
#include "scene/format_fault.h"
#include "scene/glass_image.h"
#include "scene/gltf_element.h"
#include "scene/gltf_texture_places.h"
#include "scene/gltf_textures.h"
#include "scene/one_line.h"

namespace pdsm {
namespace {

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

/// What KHR_materials_transmission's texture is, if it has one.
std::optional<tinygltf::TextureInfo> transmission_texture(const tinygltf::Material& material) {
  const auto extension = material.extensions.find(kTransmission);
  if (extension == material.extensions.end() || !extension->second.Has("transmissionTexture"))
    return std::nullopt;
  const tinygltf::Value& value = extension->second.Get("transmissionTexture");
  const auto number = [&](const char* key, int otherwise) {
    if (!value.Has(key)) return otherwise;
    if (!value.Get(key).IsInt()) throw FormatFault(fmt::format("transmissionTexture: {} is no integer", key));
    return value.Get(key).GetNumberAsInt();
  };
  tinygltf::TextureInfo use;
  use.index = number("index", -1);
  use.texCoord = number("texCoord", 0);
  if (value.Has("extensions")) {
    const tinygltf::Value& extensions = value.Get("extensions");
    for (const std::string& key : extensions.Keys()) use.extensions.emplace(key, extensions.Get(key));
  }
  return use;
}

/// What `read` reads of a texture's image; FormatFaults name the image.
template <typename Read>
auto naming_image(const GltfTexture& texture, Read&& read) {
  try {
    return read();
  } catch (const FormatFault& fault) {
    throw FormatFault(fmt::format("image {}: {}", texture.name, fault.what()));
  }
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
    return {material->alphaMode == kBlend ? factor.a : 1,
            transmission_factor(*material) * glm::dvec3(factor)};
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
  const bool has_base = material.pbrMetallicRoughness.baseColorTexture.index >= 0;
  const bool is_glass = transmission_factor(material) > 0;
  if (is_glass && (has_base || transmission_texture(material))) return read_glass_cutout(material, where);
  if (has_base) return read_picture_cutout(material, where);
  if (material.alphaMode != kMask) return {};
  return {make_mask({1, 1, {255}, true}, {}, alpha_cutoff(material)), {}};
}

GltfCutouts::Cutout GltfCutouts::read_picture_cutout(const tinygltf::Material& material,
                                                     const std::string& where) {
  const GltfTexture texture = textures_.read(material.pbrMetallicRoughness.baseColorTexture);
  const double cutoff = alpha_cutoff(material);
  return naming_image(texture, [&]() -> Cutout {
    AlphaImage alpha = read_alpha(texture.bytes, WithoutAlpha::opaque);
    if (material.alphaMode == kBlend) return {make_blend(std::move(alpha), texture.wrap), texture.places};
    if (!alpha.has_alpha)
      parts_.warn(fmt::format("{}: image {} has no alpha channel: nothing is cut out", where, texture.name));
    return {make_mask(std::move(alpha), texture.wrap, cutoff), texture.places};
  });
}

GltfCutouts::Cutout GltfCutouts::read_glass_cutout(const tinygltf::Material& material,
                                                   const std::string& where) {
  const tinygltf::TextureInfo& base_use = material.pbrMetallicRoughness.baseColorTexture;
  std::optional<GltfTexture> base, share;
  if (base_use.index >= 0) base = textures_.read(base_use);
  if (const auto use = transmission_texture(material)) share = textures_.read(*use);
  if (base && share && !base->lies_as(*share)) {
    parts_.warn(where +
                ": transmissionTexture lies otherwise than the base colour's, and is not read: "
                "transmissionFactor holds everywhere");
    share.reset();
  }
  const auto picture_of = [](const std::optional<GltfTexture>& texture) -> std::optional<Picture> {
    if (!texture) return std::nullopt;
    return naming_image(*texture, [&] { return read_picture(texture->bytes, kGlassChannels); });
  };
  const GlassAlpha alpha = material.alphaMode == kBlend  ? GlassAlpha::blends
                           : material.alphaMode == kMask ? GlassAlpha::cuts
                                                         : GlassAlpha::none;
  const GltfTexture& either = base ? *base : *share;
  return {make_glass(picture_of(base), picture_of(share), either.wrap, alpha, alpha_cutoff(material)),
          either.places};
}

std::string GltfCutouts::name_of(std::size_t material) const {
  const std::string& name = model_.materials[material].name;
  return name.empty() ? fmt::format("materials[{}]", material) : name;
}

}  // namespace pdsm
