// SPDX-License-Identifier: Apache-2.0
#include "scene/geometry_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "pdsm/bake/scene_file.h"
#include "pdsm/format/error.h"
#include "scene/one_line.h"

namespace pdsm {
namespace {

std::shared_ptr<const Mesh> turned_over(const Mesh& mesh) {
  auto result = std::make_shared<Mesh>(mesh);
  for (glm::uvec3& t : result->triangles) std::swap(t.y, t.z);
  return result;
}

/// Turns over the triangles of each part that `wanted` picks; parts that shared a mesh still share one.
template <typename Wanted>
void turn_over(std::vector<Geometry>& parts, Wanted&& wanted) {
  std::map<std::shared_ptr<const Mesh>, std::shared_ptr<const Mesh>> turned;
  for (Geometry& part : parts) {
    if (!wanted(part)) continue;
    auto& copy = turned[part.mesh];
    if (!copy) copy = turned_over(*part.mesh);
    part.mesh = copy;
  }
}

double determinant(const glm::dmat4& m) {
  return glm::determinant(glm::dmat3(m));
}

}  // namespace

std::shared_ptr<const Mesh> PartCollector::clean(const Mesh& raw, const PartNames& names) {
  ++meshes_;
  LeftOut left_out;
  auto mesh = std::make_shared<Mesh>(clean_mesh(raw, left_out));
  if (left_out.total() > 0)
    leave_out(left_out, names.material.empty() ? names.node() : names.node() + " (" + names.material + ")");
  return mesh;
}

void PartCollector::leave_out(const LeftOut& left_out, const std::string& where) {
  add_left_out(left_out);
  const std::string name = one_line(where);
  if (!name.empty() && told_.insert(name).second) file_.left_out_of.push_back(name);
}

void PartCollector::add_left_out(const LeftOut& left_out) {
  file_.left_out.bad_index += left_out.bad_index;
  file_.left_out.not_finite += left_out.not_finite;
  file_.left_out.no_area += left_out.no_area;
}

void PartCollector::warn(const std::string& text) {
  if (std::ranges::find(file_.warnings, text) == file_.warnings.end()) file_.warnings.push_back(text);
}

void PartCollector::add(const PartNames& names, const std::shared_ptr<const Mesh>& mesh,
                        const glm::dmat4& local_to_file, const std::optional<glm::vec3>& base_color,
                        const Translucency& translucency) {
  if (mesh->triangles.empty()) return;
  const double volume = determinant(local_to_file);
  if (volume == 0 || !std::isfinite(volume)) {
    LeftOut left_out;
    (volume == 0 ? left_out.no_area : left_out.not_finite) = mesh->triangles.size();
    leave_out(left_out, names.node());
    return;
  }
  Geometry part;
  part.name = names.node();
  part.mesh = mesh;
  part.local_to_world = local_to_file;
  if (base_color) part.base_color = *base_color;
  part.opacity = translucency.opacity;
  part.transmission = translucency.transmission;
  file_.parts.push_back(std::move(part));
  file_.names.push_back(names);
}

ImportedFile PartCollector::take() {
  for (Geometry& part : file_.parts) {
    const bool named = file_.parts.size() > 1 && !part.name.empty();
    part.name = named ? file_name_ + ":" + part.name : file_name_;
  }
  turn_over(file_.parts, [](const Geometry& part) { return determinant(part.local_to_world) < 0; });
  // Of a file's only mesh, its name tells nothing more.
  if (meshes_ < 2) file_.left_out_of.clear();
  return std::move(file_);
}

std::string describe_left_out(const ImportedFile& file) {
  constexpr std::size_t kMostNames = 3;
  std::string text = describe(file.left_out);
  const std::size_t count = file.left_out_of.size(), named = std::min(count, kMostNames);
  for (std::size_t n = 0; n < named; ++n) {
    const char* before = n == 0 ? ", of " : n + 1 == count ? " and " : ", ";
    text += before + file.left_out_of[n];
  }
  if (count > named) text += fmt::format(" and {} more", count - named);
  return text;
}

void place(std::vector<Geometry>& parts, const glm::dmat4& placement) {
  for (Geometry& part : parts) part.local_to_world = placement * part.local_to_world;
  if (determinant(placement) < 0) turn_over(parts, [](const Geometry&) { return true; });
}

std::filesystem::path unpacked_name(const std::filesystem::path& path) {
  return has_extension(path, ".gz") ? path.parent_path() / path.stem() : path;
}

bool is_gltf_name(const std::filesystem::path& name) {
  return has_extension(name, ".gltf") || has_extension(name, ".glb");
}

ImportedFile import_file(FileSource& files, const std::filesystem::path& path) {
  std::string bytes = files.read_unpacked(path);
  const std::filesystem::path name = unpacked_name(path);
  if (is_gltf_name(name)) return import_gltf(files, name, std::move(bytes));
  if (has_extension(name, ".ply")) return import_ply(name, bytes);
  return import_with_assimp(files, name, std::move(bytes));
}

std::vector<Geometry> import_geometry(const std::filesystem::path& path) {
  FileSource files;
  return import_file(files, path).parts;
}

}  // namespace pdsm
