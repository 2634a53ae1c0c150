// SPDX-License-Identifier: Apache-2.0
// glTF and GLB files, as far as they are ours: what tinygltf has parsed, however wrong, becomes meshes.
#include <string>

#include "fuzz_target.h"
#include "imported_parts.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pdsm::testing;
  // Nothing lies beneath a file, so that no buffer that the input names is found.
  constexpr const char* kName = "/dev/null/a.glb";
  refused_or_read([&] {
    pdsm::FileSource files;
    demand_sound(pdsm::import_gltf(files, kName, std::string(reinterpret_cast<const char*>(data), size)));
  });
  return 0;
}
