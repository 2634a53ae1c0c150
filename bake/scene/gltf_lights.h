// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pdsm/bake/scene.h"
#include "scene/read_light.h"
#include "scene/tiny_gltf.h"

namespace pdsm {

/// The lights of a glTF file that is the scene (docs/scene.md), taken node by node. A node's own
/// extras.pdsm_light comes before EXT_lights_area, and that before KHR_lights_punctual.
class GltfLights {
 public:
  /// `file` is for messages.
  GltfLights(std::string file, EmissionReader read_emission)
      : file_(std::move(file)), read_emission_(std::move(read_emission)) {}

  /// Takes the light of a node, if it has one. Throws Error (input) "file:nodes[2].extras...: reason".
  void take(const tinygltf::Model& model, std::size_t node, const glm::dmat4& node_to_file);

  std::vector<Light> lights;
  std::vector<std::string> warnings;  ///< lights that were left out, and why

 private:
  void add(const Light& light, const std::string& path);

  std::string file_;
  EmissionReader read_emission_;
  std::optional<nlohmann::json> extensions_;    ///< the file's
  std::map<std::string, std::string> node_of_;  ///< by light's name
};

}  // namespace pdsm
