// SPDX-License-Identifier: Apache-2.0
// Scene files: JSON, its fields, placements, lights.
#include <string_view>

#include "fuzz_target.h"
#include "pdsm/bake/scene_file.h"
#include "scratch_input.h"

namespace pdsm::testing {
namespace {

/// A closed mesh that scenes can name, so that what follows an import is reached too.
constexpr std::string_view kTetrahedron =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::span<const std::uint8_t> as_bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// A scratch folder with the one mesh there is.
struct SceneFolder : ScratchInput {
  SceneFolder() { write("tetrahedron.ply", as_bytes(kTetrahedron)); }
};

}  // namespace
}  // namespace pdsm::testing

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pdsm::testing;
  static const SceneFolder folder;
  // No scene is likely to name itself as geometry by this name; Assimp would read it then.
  const auto path = folder.write("scene-that-is-fuzzed.json", {data, size});
  refused_or_read([&] {
    const pdsm::Scene scene = pdsm::read_scene(path);
    for (const pdsm::Light& light : scene.lights) static_cast<void>(pdsm::light_frame(light));
  });
  return 0;
}
