// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "pdsm/bake/scene.h"
#include "scene/file_source.h"
#include "scene/mesh_cleanup.h"
#include "scene/part_names.h"

namespace pdsm {

class GltfLights;

/// What one geometry file holds.
struct ImportedFile {
  std::vector<Geometry> parts;   ///< without triangles: none
  std::vector<PartNames> names;  ///< one a part
  LeftOut left_out;
  std::vector<std::string>
      left_out_of;                    ///< nodes and materials that had those, each once, where there are more
  std::vector<std::string> warnings;  ///< besides what was left out; without the file's name
};

/// Reads a geometry file and what it refers to. Throws Error (input) "path: reason".
[[nodiscard]] ImportedFile import_file(FileSource& files, const std::filesystem::path& path);

/// The same of one kind of file, whose bytes are read already. `name` is the path without .gz. Lights of
/// glTF are left alone without `lights` to take them.
[[nodiscard]] ImportedFile import_gltf(FileSource& files, const std::filesystem::path& name,
                                       std::string bytes, GltfLights* lights = nullptr);
[[nodiscard]] ImportedFile import_ply(const std::filesystem::path& name, const std::string& bytes);
[[nodiscard]] ImportedFile import_with_assimp(FileSource& files, const std::filesystem::path& name,
                                              std::string bytes);

/// The path without .gz.
[[nodiscard]] std::filesystem::path unpacked_name(const std::filesystem::path& path);

/// Whether a file of this name, unpacked, is glTF or GLB.
[[nodiscard]] bool is_gltf_name(const std::filesystem::path& name);

/// "12 triangles without area left out, of wall (brick), roof and 3 more"; empty where none were.
[[nodiscard]] std::string describe_left_out(const ImportedFile& file);

/// What a part's surfaces let through: see Geometry.
struct Translucency {
  double opacity = 1;
  glm::dvec3 transmission{0};
};

/// Gathers the parts of a file: meshes under node transforms.
class PartCollector {
 public:
  explicit PartCollector(std::string file_name) : file_name_(std::move(file_name)) {}

  /// Cleans a mesh for any number of parts; the names, of the first, are for the warning.
  [[nodiscard]] std::shared_ptr<const Mesh> clean(const Mesh& raw, const PartNames& names);

  /// Counts triangles that the file's reader has left out itself.
  void add_left_out(const LeftOut& left_out);

  /// Adds a warning, once.
  void warn(const std::string& text);

  /// Adds a part. One without triangles is passed over; one that its node flattens counts as left out.
  void add(const PartNames& names, const std::shared_ptr<const Mesh>& mesh, const glm::dmat4& local_to_file,
           const std::optional<glm::vec3>& base_color, const Translucency& translucency = {});

  /// Everything gathered; parts are named "file", or "file:node" when there are several.
  [[nodiscard]] ImportedFile take();

 private:
  void leave_out(const LeftOut& left_out, const std::string& where);

  std::string file_name_;
  ImportedFile file_;
  std::size_t meshes_ = 0;
  std::set<std::string> told_;  ///< what left_out_of names
};

/// Places parts: local_to_world = placement * local_to_world. Where the placement mirrors, triangles are
/// turned over, so that their fronts stay fronts.
void place(std::vector<Geometry>& parts, const glm::dmat4& placement);

}  // namespace pdsm
