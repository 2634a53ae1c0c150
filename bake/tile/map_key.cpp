// SPDX-License-Identifier: Apache-2.0
#include "pdsm/bake/map_key.h"

#include <utility>

#include "tile/setup_key.h"
#include "tile/view_jobs.h"
#include "trace/embree_scene.h"

namespace pdsm {

const char* const kToolVersion = PDSM_VERSION;

MapKey map_key(const Scene& scene, const Light& light, const BakeOptions& options,
               const std::string& version) {
  const std::string isa = options.isa.empty() ? choose_isa("") : options.isa;
  const auto views = make_views<BakeSetup>(scene, light, options);
  std::vector<FittedView> fitted;
  for (const auto& view : views)
    if (view->part.channel == 0) fitted.push_back(view->fitted);
  std::vector<std::string> warnings = geometry_warnings(views.front()->light_space.dropped_triangles);
  for (std::string& warning : view_warnings(fitted)) warnings.push_back(std::move(warning));
  return {views_key(views, light, isa, version), sum_up_views(fitted), std::move(warnings)};
}

}  // namespace pdsm
