// SPDX-License-Identifier: Apache-2.0
#include "pdsm/bake/map_key.h"

#include "tile/bake_facts.h"
#include "tile/setup_key.h"
#include "trace/embree_scene.h"

namespace pdsm {

const char* const kToolVersion = PDSM_VERSION;

MapKey map_key(const Scene& scene, const Light& light, const BakeOptions& options,
               const std::string& version) {
  const std::string isa = options.isa.empty() ? choose_isa("") : options.isa;
  const BakeSetup setup(scene, light, options);
  return {setup_key(setup, light, isa, version), setup.fitted,
          geometry_warnings(setup.light_space.dropped_triangles)};
}

}  // namespace pdsm
