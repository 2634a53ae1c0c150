// SPDX-License-Identifier: Apache-2.0
#include "scene/assimp_cutouts.h"

#include <assimp/material.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "pdsm/format/error.h"
#include "scene/alpha_image.h"
#include "scene/format_fault.h"
#include "scene/one_line.h"

namespace pdsm {
namespace {

/// The format has no cutoff; what is rather there than not is there.
constexpr double kCutoff = 0.5;

MaskWrap wrap_of(aiTextureMapMode mode) {
  if (mode == aiTextureMapMode_Mirror) return MaskWrap::mirror;
  return mode == aiTextureMapMode_Wrap ? MaskWrap::repeat : MaskWrap::clamp;
}

std::string name_of(const aiMaterial& material, unsigned index) {
  aiString name;
  const bool named = material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && name.length > 0;
  return named ? name.C_Str() : fmt::format("material {}", index);
}

}  // namespace

void AssimpCutouts::cut_out(const aiMesh& source, Mesh& mesh) {
  const unsigned index = source.mMaterialIndex;
  if (!has_extension(name_, ".obj") || index >= scene_.mNumMaterials) return;
  const aiMaterial& material = *scene_.mMaterials[index];
  if (material.GetTextureCount(aiTextureType_OPACITY) == 0) return;
  try {
    const auto [known, fresh] = masks_.try_emplace(index);
    if (fresh) known->second = read_mask(material);
    if (!known->second) return;
    if (!source.HasTextureCoords(0)) throw FormatFault("a mesh has no texture coordinates");
    mesh.mask = known->second;
    // An OBJ file's v points up, a picture's rows go down.
    for (const aiVector3D& place : std::span(source.mTextureCoords[0], source.mNumVertices))
      mesh.mask_places.emplace_back(place.x, 1 - place.y);
  } catch (const std::exception& fault) {
    throw Error(Failure::input, name_.string() + ":" + name_of(material, index), one_line(fault.what()));
  }
}

double AssimpCutouts::opacity(const aiMesh& source) const {
  const unsigned index = source.mMaterialIndex;
  if (!has_extension(name_, ".obj") || index >= scene_.mNumMaterials) return 1;
  const aiMaterial& material = *scene_.mMaterials[index];
  float opacity = 1;
  if (material.GetTextureCount(aiTextureType_OPACITY) > 0 ||
      material.Get(AI_MATKEY_OPACITY, opacity) != aiReturn_SUCCESS)
    return 1;
  if (opacity >= 0 && opacity <= 1) return static_cast<double>(opacity);
  throw Error(Failure::input, name_.string() + ":" + name_of(material, index), "d must be from 0 to 1");
}

std::shared_ptr<const CutoutMask> AssimpCutouts::read_mask(const aiMaterial& material) {
  aiString path;
  std::array<aiTextureMapMode, 2> modes{aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
  material.GetTexture(aiTextureType_OPACITY, 0, &path, nullptr, nullptr, nullptr, nullptr, modes.data());
  float opacity = 1;
  material.Get(AI_MATKEY_OPACITY, opacity);
  std::string name = path.C_Str();
  // Written on Windows as often as not.
  std::ranges::replace(name, '\\', '/');
  const double cutoff = opacity > 0 ? kCutoff / static_cast<double>(opacity) : HUGE_VAL;
  try {
    const std::string bytes = files_.read(name_.parent_path() / name);
    return make_mask(read_alpha(bytes, WithoutAlpha::brightness), {wrap_of(modes[0]), wrap_of(modes[1])},
                     cutoff);
  } catch (const FormatFault& fault) {
    throw FormatFault(fmt::format("image {}: {}", name, fault.what()));
  }
}

}  // namespace pdsm
