// SPDX-License-Identifier: Apache-2.0
// glTF and GLB files, as far as they are ours: what tinygltf has parsed, however wrong, becomes meshes and
// lights.
#include <string>

#include "fuzz_target.h"
#include "imported_parts.h"
#include "light/light_axes.h"
#include "scene/gltf_lights.h"

namespace pdsm::testing {
namespace {

void demand_frame(const Light& light) {
  demand(!light.name.empty(), "a light with a name");
  demand(frame_fault(light) == FrameFault::none, "a light with a frame");
}

}  // namespace
}  // namespace pdsm::testing

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pdsm::testing;
  // Nothing lies beneath a file, so that no buffer that the input names is found.
  constexpr const char* kName = "/dev/null/a.glb";
  refused_or_read([&] {
    pdsm::FileSource files;
    pdsm::GltfLights lights(kName, [](const pdsm::JsonFields& fields) {
      fields.refuse("emission", "no such file");
      return nullptr;
    });
    demand_sound(
        pdsm::import_gltf(files, kName, std::string(reinterpret_cast<const char*>(data), size), &lights));
    for (const pdsm::Light& light : lights.lights) demand_frame(light);
  });
  return 0;
}
