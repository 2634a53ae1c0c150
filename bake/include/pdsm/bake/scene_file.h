// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// Reads a scene file (docs/scene.schema.json describes it) and the geometry it names. Every fault throws
/// Error (input) "file:field: reason", e.g. "level.scene.json:lights[0].width: must be a number > 0";
/// malformed JSON names its line. Geometry: whatever Assimp reads; glTF and GLB by tinygltf; a name that
/// ends in .gz is unpacked. Unknown keys are faults. Safe on untrusted scene files; one thread.
[[nodiscard]] Scene read_scene(const std::filesystem::path& path);

/// Reads one geometry file alone: its meshes with their node transforms applied. Same faults.
[[nodiscard]] std::vector<Geometry> import_geometry(const std::filesystem::path& path);

}  // namespace pdsm
