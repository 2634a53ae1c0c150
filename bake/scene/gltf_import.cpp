// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include "pdsm/format/error.h"
#include "scene/format_fault.h"
#include "scene/geometry_import.h"
#include "scene/gltf_accessor.h"
#include "scene/gltf_cutouts.h"
#include "scene/gltf_element.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_transform.h"
#include "scene/json_document.h"
#include "scene/one_line.h"
#include "scene/tiny_gltf.h"

namespace pdsm {
namespace {

// What a file may demand of its reader and this one fulfils or may ignore, as only shapes are wanted, and
// what is cut out of them.
constexpr std::array kIgnorableExtensions = {"KHR_mesh_quantization", "KHR_texture_transform",
                                             "KHR_lights_punctual", "EXT_lights_area",
                                             "EXT_mesh_gpu_instancing"};

bool is_image_name(const std::filesystem::path& path) {
  return std::ranges::any_of(std::array{".png", ".jpg", ".jpeg", ".webp", ".ktx2", ".dds", ".basis"},
                             [&](const char* extension) { return has_extension(path, extension); });
}

/// Lets tinygltf read buffers through FileSource, and finds no image files: few of them are wanted, and those
/// are read later (gltf_cutouts.h).
tinygltf::FsCallbacks file_callbacks(FileSource& files) {
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string& name, void*) {
    std::error_code error;
    return !is_image_name(name) && std::filesystem::is_regular_file(name, error);
  };
  callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* to, std::string* fault, const std::string& name,
                               void* source) {
    try {
      const std::string bytes = static_cast<FileSource*>(source)->read(name);
      to->assign(bytes.begin(), bytes.end());
      return true;
    } catch (const Error& error) {
      if (fault != nullptr) *fault += error.what();
      return false;
    }
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  callbacks.user_data = &files;
  return callbacks;
}

// tinygltf and what it is built on recurse into what extras hold.
constexpr std::size_t kDeepest = 256;

/// The JSON of a file: all of it, or the first chunk of a GLB.
std::string_view json_of(const std::string& bytes, bool binary) {
  constexpr std::size_t kLengthAt = 12, kTextAt = 20;
  if (!binary) return bytes;
  if (bytes.size() < kTextAt) return {};
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + kLengthAt, sizeof length);
  return std::string_view(bytes).substr(kTextAt, length);
}

tinygltf::Model parse(FileSource& files, const std::filesystem::path& name, const std::string& bytes) {
  if (bytes.size() > std::numeric_limits<unsigned>::max()) throw FormatFault("is larger than 4 GiB");
  tinygltf::TinyGLTF loader;
  loader.SetStoreOriginalJSONForExtrasAndExtensions(true);
  loader.SetImageLoader(keep_image_bytes, nullptr);
  loader.SetFsCallbacks(file_callbacks(files));
  const auto size = static_cast<unsigned>(bytes.size());
  const std::string folder = name.has_parent_path() ? name.parent_path().string() : ".";
  const bool binary = bytes.starts_with("glTF");
  if (is_nested_deeper(json_of(bytes, binary), kDeepest)) throw FormatFault("is nested too deeply");
  tinygltf::Model model;
  std::string fault, warning;
  const bool good =
      binary ? loader.LoadBinaryFromMemory(&model, &fault, &warning,
                                           reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
             : loader.LoadASCIIFromString(&model, &fault, &warning, bytes.data(), size, folder);
  if (!good) throw FormatFault(fault.empty() ? "is not valid glTF" : fault);
  return model;
}

void check_extensions(const tinygltf::Model& model) {
  for (const std::string& extension : model.extensionsRequired) {
    const bool ignorable =
        std::ranges::any_of(kIgnorableExtensions, [&](const char* known) { return extension == known; });
    // Materials change how a surface looks, not where it is.
    if (!ignorable && !extension.starts_with("KHR_materials_")) {
      throw FormatFault("requires the extension " + extension + ": not supported yet");
    }
  }
}

/// Corner numbers of each triangle of a primitive; points and lines have none.
std::vector<glm::uvec3> make_triangles(const std::vector<std::uint32_t>& indices, int mode) {
  std::vector<glm::uvec3> triangles;
  const std::size_t count = indices.size();
  if (mode == TINYGLTF_MODE_TRIANGLES || mode == -1) {
    for (std::size_t i = 0; i + 2 < count; i += 3)
      triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    // Every second triangle of a strip is wound the other way.
    for (std::size_t i = 0; i + 2 < count; ++i) {
      triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
    }
  } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
    for (std::size_t i = 1; i + 1 < count; ++i)
      triangles.emplace_back(indices[i], indices[i + 1], indices[0]);
  }
  return triangles;
}

Mesh to_mesh(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  Mesh mesh;
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) return mesh;
  mesh.positions = read_positions(model, position->second);
  std::vector<std::uint32_t> indices;
  if (primitive.indices >= 0) {
    indices = read_indices(model, primitive.indices);
  } else {
    indices.resize(mesh.positions.size());
    std::iota(indices.begin(), indices.end(), 0U);
  }
  mesh.triangles = make_triangles(indices, primitive.mode);
  return mesh;
}

std::optional<glm::vec3> base_color(const tinygltf::Model& model, int index) {
  const tinygltf::Material* material = find_element(model.materials, index);
  if (material == nullptr) return std::nullopt;
  const auto& factor = material->pbrMetallicRoughness.baseColorFactor;
  if (factor.size() < 3) return std::nullopt;
  return glm::clamp(glm::vec3(factor[0], factor[1], factor[2]), 0.0F, 1.0F);
}

std::string material_name(const tinygltf::Model& model, int index) {
  const tinygltf::Material* material = find_element(model.materials, index);
  return material != nullptr ? material->name : "";
}

/// The nodes to begin with: those of the default scene, or without scenes all that are no one's child.
std::vector<int> root_nodes(const tinygltf::Model& model) {
  if (!model.scenes.empty()) {
    const int scene = std::max(model.defaultScene, 0);
    if (static_cast<std::size_t>(scene) >= model.scenes.size()) throw FormatFault("scene does not exist");
    return model.scenes[static_cast<std::size_t>(scene)].nodes;
  }
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) {
      if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
        is_child[static_cast<std::size_t>(child)] = true;
    }
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

/// A node that is still to be visited.
struct OpenNode {
  int index = 0;
  glm::dmat4 parent_to_file{1.0};
  std::vector<std::string> parents;  ///< their names, the nearest first
};

/// Walks the node hierarchy and hands over each mesh's primitives, and lights if they are wanted; a mesh is
/// read once.
class NodeWalk {
 public:
  NodeWalk(const tinygltf::Model& model, GltfCutouts& cutouts, PartCollector& parts, GltfLights* lights)
      : model_(model),
        cutouts_(cutouts),
        parts_(parts),
        lights_(lights),
        visited_(model.nodes.size(), false),
        meshes_(model.meshes.size()) {}

  void run() {
    for (const int root : root_nodes(model_)) open_.push_back({root, glm::dmat4(1.0), {}});
    std::ranges::reverse(open_);
    while (!open_.empty()) {
      const OpenNode next = std::move(open_.back());
      open_.pop_back();
      visit(next);
    }
  }

 private:
  void visit(const OpenNode& open) {
    const tinygltf::Node& node = element(model_.nodes, open.index, "nodes");
    const auto i = static_cast<std::size_t>(open.index);
    if (visited_[i]) throw FormatFault(fmt::format("nodes[{}] has more than one parent", open.index));
    visited_[i] = true;
    const glm::dmat4 node_to_file = open.parent_to_file * node_matrix(node);
    std::vector<std::string> names{node.name};
    names.insert(names.end(), open.parents.begin(), open.parents.end());
    if (names.size() > kMostNodeNames) names.pop_back();
    if (node.mesh >= 0) add_mesh(node, names, node_to_file);
    if (lights_ != nullptr) lights_->take(model_, i, node_to_file);
    for (std::size_t child = node.children.size(); child-- > 0;)
      open_.push_back({node.children[child], node_to_file, names});
  }

  std::shared_ptr<const Mesh> read(const tinygltf::Primitive& primitive, const PartNames& names) {
    Mesh mesh = to_mesh(model_, primitive);
    cutouts_.cut_out(primitive, mesh);
    return parts_.clean(mesh, names);
  }

  void add_mesh(const tinygltf::Node& node, const std::vector<std::string>& nodes,
                const glm::dmat4& node_to_file) {
    const tinygltf::Mesh& source = element(model_.meshes, node.mesh, "meshes");
    const std::vector<glm::dmat4> instances = instance_matrices(model_, node);
    PartNames names{nodes, ""};
    if (node.name.empty()) names.nodes.front() = source.name;
    auto& primitives = meshes_[static_cast<std::size_t>(node.mesh)];
    for (std::size_t p = 0; p < source.primitives.size(); ++p) {
      const int material = source.primitives[p].material;
      names.material = material_name(model_, material);
      if (primitives.size() == p) primitives.push_back(read(source.primitives[p], names));
      const std::optional<glm::vec3> colour = base_color(model_, material);
      const Translucency translucency = cutouts_.translucency(material);
      for (const glm::dmat4& instance : instances)
        parts_.add(names, primitives[p], node_to_file * instance, colour, translucency);
    }
  }

  const tinygltf::Model& model_;
  GltfCutouts& cutouts_;
  PartCollector& parts_;
  GltfLights* lights_;
  std::vector<bool> visited_;
  std::vector<std::vector<std::shared_ptr<const Mesh>>> meshes_;
  std::vector<OpenNode> open_;
};

}  // namespace

ImportedFile import_gltf(FileSource& files, const std::filesystem::path& name, std::string bytes,
                         GltfLights* lights) {
  PartCollector parts(name.filename().string());
  try {
    const tinygltf::Model model = parse(files, name, bytes);
    check_extensions(model);
    GltfCutouts cutouts(files, name, model, parts);
    NodeWalk(model, cutouts, parts, lights).run();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& fault) {
    throw Error(Failure::input, name.string(), one_line(fault.what()));
  }
  return parts.take();
}

}  // namespace pdsm
