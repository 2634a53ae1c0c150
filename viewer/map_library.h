// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "file_signature.h"
#include "messages.h"
#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// A line of a table: what, and how much of it.
using Fact = std::pair<std::string, std::string>;

/// A map that was read, and the light of the scene that it belongs to.
struct LoadedMap {
  std::filesystem::path path;
  std::optional<FileSignature> signature;  ///< of the file as it was last looked at
  PenumbraMap map;
  std::size_t light = 0;  ///< index in the scene
  std::vector<Fact> facts;
};

/// The maps of a scene. Each belongs to the light that it names; a second one for a light is refused, or
/// takes the first one's place when it is dropped on the window.
class MapLibrary {
 public:
  [[nodiscard]] const std::vector<LoadedMap>& maps() const { return maps_; }
  /// The map of a light, null without one.
  [[nodiscard]] const LoadedMap* of_light(std::size_t light) const;

  /// Reads a map. Throws Error: (input) when it is bad or of no light of the scene, (usage) when its light
  /// has one already and `replace` is not set. Warns when the scene has changed since the bake.
  void add(const std::filesystem::path& path, const Scene& scene, bool replace, Messages& messages);

  /// Reads files anew that have changed; one that turned bad keeps its old map and says so once. True when
  /// any map is another one now.
  bool refresh(const Scene& scene, Messages& messages);

 private:
  [[nodiscard]] LoadedMap load(const std::filesystem::path& path, std::size_t index,
                               const Scene& scene) const;
  bool refresh_map(std::size_t index, const Scene& scene, Messages& messages);

  std::vector<LoadedMap> maps_;
};

}  // namespace pdsm
