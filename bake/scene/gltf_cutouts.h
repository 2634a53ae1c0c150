// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "scene/geometry_import.h"
#include "scene/gltf_textures.h"
#include "scene/tiny_gltf.h"

namespace pdsm {

/// What the materials of a glTF file cut out of its meshes (alphaMode MASK), and how much light they let
/// through (BLEND, and KHR_materials_transmission).
class GltfCutouts {
 public:
  /// Borrows all but the name. Warnings go to `parts`.
  GltfCutouts(FileSource& files, std::filesystem::path name, const tinygltf::Model& model,
              PartCollector& parts)
      : name_(std::move(name)), model_(model), textures_(files, name_, model), parts_(parts) {}

  /// Gives the mesh of a primitive the mask of its material and its places there, if anything is cut out or
  /// blends.
  /// Throws Error (input) "file:material: reason".
  void cut_out(const tinygltf::Primitive& primitive, Mesh& mesh);

  /// What a material lets through, besides what its mask says. Throws as cut_out() does.
  [[nodiscard]] Translucency translucency(int index);

 private:
  struct Cutout;

  [[nodiscard]] const Cutout& cutout_of(std::size_t material);
  [[nodiscard]] Cutout read_cutout(const tinygltf::Material& material, const std::string& where);
  [[nodiscard]] Cutout read_picture_cutout(const tinygltf::Material& material, const std::string& where);
  [[nodiscard]] Cutout read_glass_cutout(const tinygltf::Material& material, const std::string& where);
  [[nodiscard]] std::string name_of(std::size_t material) const;

  const std::filesystem::path name_;
  const tinygltf::Model& model_;
  const GltfTextures textures_;
  PartCollector& parts_;
  std::map<std::size_t, std::shared_ptr<const Cutout>> cutouts_;  // by material
};

}  // namespace pdsm
