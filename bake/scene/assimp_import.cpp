// SPDX-License-Identifier: Apache-2.0
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cstring>
#include <optional>
#include <utility>

#include "pdsm/format/error.h"
#include "scene/assimp_cutouts.h"
#include "scene/geometry_import.h"
#include "scene/one_line.h"

namespace pdsm {
namespace {

/// A file in memory, as Assimp reads it.
class MemoryStream : public Assimp::IOStream {
 public:
  explicit MemoryStream(std::shared_ptr<const std::string> bytes) : bytes_(std::move(bytes)) {}

  size_t Read(void* to, size_t size, size_t count) override {
    if (size == 0) return 0;
    const std::size_t items = std::min(count, (bytes_->size() - at_) / size);
    std::memcpy(to, bytes_->data() + at_, items * size);
    at_ += items * size;
    return items;
  }
  size_t Write(const void*, size_t, size_t) override { return 0; }
  aiReturn Seek(size_t offset, aiOrigin origin) override {
    const std::size_t size = bytes_->size();
    const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : size;
    // An offset from the end counts backwards.
    const std::size_t target = origin == aiOrigin_END ? base - offset : base + offset;
    if (target > size) return aiReturn_FAILURE;
    at_ = target;
    return aiReturn_SUCCESS;
  }
  size_t Tell() const override { return at_; }
  size_t FileSize() const override { return bytes_->size(); }
  void Flush() override {}

 private:
  std::shared_ptr<const std::string> bytes_;
  std::size_t at_ = 0;
};

/// Gives Assimp the file that is in memory already and lets it read what that refers to through
/// FileSource: regular files only, all part of the scene's hash.
class SceneFileSystem : public Assimp::IOSystem {
 public:
  SceneFileSystem(FileSource& files, std::string main_name, std::shared_ptr<const std::string> main_bytes)
      : files_(files), main_name_(std::move(main_name)), main_bytes_(std::move(main_bytes)) {}

  bool Exists(const char* name) const override {
    std::error_code error;
    return name == main_name_ || std::filesystem::is_regular_file(name, error);
  }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (mode[0] != 'r') return nullptr;
    if (name == main_name_) return new MemoryStream(main_bytes_);
    try {
      return new MemoryStream(std::make_shared<const std::string>(files_.read(name)));
    } catch (const Error&) {
      // Assimp carries on without, or says what it misses.
      return nullptr;
    }
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  FileSource& files_;
  std::string main_name_;
  std::shared_ptr<const std::string> main_bytes_;
};

glm::dmat4 to_matrix(const aiMatrix4x4& m) {
  // Assimp stores rows, GLM columns.
  return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

/// Makes points of polygons with corners out of range, so that triangulation never follows those.
std::uint64_t disarm_polygons(aiMesh& mesh) {
  std::uint64_t triangles = 0;
  for (aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
    if (face.mNumIndices <= 3) continue;
    const auto indices = std::span(face.mIndices, face.mNumIndices);
    if (std::ranges::all_of(indices, [&](unsigned i) { return i < mesh.mNumVertices; })) continue;
    triangles += face.mNumIndices - 2;
    face.mNumIndices = 1;
  }
  return triangles;
}

Mesh to_mesh(const aiMesh& source) {
  Mesh mesh;
  mesh.positions.reserve(source.mNumVertices);
  for (const aiVector3D& p : std::span(source.mVertices, source.mNumVertices)) {
    mesh.positions.emplace_back(p.x, p.y, p.z);
  }
  mesh.triangles.reserve(source.mNumFaces);
  for (const aiFace& face : std::span(source.mFaces, source.mNumFaces)) {
    // Points and lines have no area.
    if (face.mNumIndices != 3) continue;
    mesh.triangles.emplace_back(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
  }
  return mesh;
}

/// The name of a mesh's material, when the file itself has named it.
std::optional<std::string> given_name(const aiScene& scene, const aiMesh& mesh) {
  aiString name;
  const bool given = mesh.mMaterialIndex < scene.mNumMaterials &&
                     scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS &&
                     std::strcmp(name.C_Str(), AI_DEFAULT_MATERIAL_NAME) != 0;
  if (!given) return std::nullopt;
  return name.C_Str();
}

/// The diffuse colour of such a material.
std::optional<glm::vec3> base_color(const aiScene& scene, const aiMesh& mesh) {
  aiColor3D color;
  if (!given_name(scene, mesh) ||
      scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_COLOR_DIFFUSE, color) != aiReturn_SUCCESS)
    return std::nullopt;
  return glm::clamp(glm::vec3(color.r, color.g, color.b), 0.0F, 1.0F);
}

/// The names of a node and its parents.
std::vector<std::string> node_names(const aiNode* node) {
  std::vector<std::string> names;
  for (; node != nullptr && names.size() < kMostNodeNames; node = node->mParent)
    names.emplace_back(node->mName.C_Str());
  return names;
}

/// Adds the meshes of all nodes, depth first.
void collect_nodes(const aiScene& scene, AssimpCutouts&& cutouts, PartCollector& parts) {
  std::vector<std::shared_ptr<const Mesh>> meshes(scene.mNumMeshes);
  std::vector<std::pair<const aiNode*, glm::dmat4>> open;
  if (scene.mRootNode != nullptr) open.emplace_back(scene.mRootNode, glm::dmat4(1.0));
  while (!open.empty()) {
    const auto [node, parent_to_file] = open.back();
    open.pop_back();
    const glm::dmat4 node_to_file = parent_to_file * to_matrix(node->mTransformation);
    for (const unsigned index : std::span(node->mMeshes, node->mNumMeshes)) {
      if (index >= scene.mNumMeshes) continue;
      const aiMesh& mesh = *scene.mMeshes[index];
      const PartNames names{node_names(node), given_name(scene, mesh).value_or("")};
      if (!meshes[index]) {
        Mesh raw = to_mesh(mesh);
        cutouts.cut_out(mesh, raw);
        meshes[index] = parts.clean(raw, names);
      }
      parts.add(names, meshes[index], node_to_file, base_color(scene, mesh), {cutouts.opacity(mesh)});
    }
    for (unsigned i = node->mNumChildren; i-- > 0;) open.emplace_back(node->mChildren[i], node_to_file);
  }
}

/// Reads without any post-processing, then triangulates what needs it.
const aiScene& read_and_triangulate(Assimp::Importer& importer, const std::string& name, std::uint64_t& bad) {
  const auto refuse = [&] { throw Error(Failure::input, name, one_line(importer.GetErrorString())); };
  if (importer.ReadFile(name, 0) == nullptr) refuse();
  bool polygons = false;
  const aiScene* scene = importer.GetScene();
  for (aiMesh* mesh : std::span(scene->mMeshes, scene->mNumMeshes)) {
    if ((mesh->mPrimitiveTypes & static_cast<unsigned>(aiPrimitiveType_POLYGON)) == 0) continue;
    bad += disarm_polygons(*mesh);
    polygons = true;
  }
  if (polygons && importer.ApplyPostProcessing(aiProcess_Triangulate) == nullptr) refuse();
  return *importer.GetScene();
}

}  // namespace

ImportedFile import_with_assimp(FileSource& files, const std::filesystem::path& name, std::string bytes) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  // The importer owns its file system.
  importer.SetIOHandler(
      new SceneFileSystem(files, name.string(), std::make_shared<const std::string>(std::move(bytes))));
  PartCollector parts(name.filename().string());
  LeftOut bad_polygons;
  try {
    const aiScene& scene = read_and_triangulate(importer, name.string(), bad_polygons.bad_index);
    collect_nodes(scene, AssimpCutouts(files, name, scene), parts);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& fault) {
    throw Error(Failure::input, name.string(), one_line(fault.what()));
  }
  parts.add_left_out(bad_polygons);
  return parts.take();
}

}  // namespace pdsm
