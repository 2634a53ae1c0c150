// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <assimp/scene.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "scene/geometry_import.h"

namespace pdsm {

/// What the materials of an OBJ file cut out of its meshes (map_d). Other kinds of files that Assimp reads
/// cut out nothing.
class AssimpCutouts {
 public:
  /// Borrows all but the name.
  AssimpCutouts(FileSource& files, std::filesystem::path name, const aiScene& scene)
      : files_(files), name_(std::move(name)), scene_(scene) {}

  /// Gives the mesh that was made of `source` the mask of its material and its places there, if anything is
  /// cut out. Throws Error (input) "file:material: reason".
  void cut_out(const aiMesh& source, Mesh& mesh);

  /// The opacity of a mesh's material, besides its mask: `d`, or 1 - `Tr`, of an OBJ file's material without
  /// map_d.
  [[nodiscard]] double opacity(const aiMesh& source) const;

 private:
  [[nodiscard]] std::shared_ptr<const CutoutMask> read_mask(const aiMaterial& material);

  FileSource& files_;
  const std::filesystem::path name_;
  const aiScene& scene_;
  std::map<unsigned, std::shared_ptr<const CutoutMask>> masks_;  // by material
};

}  // namespace pdsm
