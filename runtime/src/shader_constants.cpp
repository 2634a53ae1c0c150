// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "map_packing.h"

namespace pdsm {

std::string shader_constants(const MapTextures& textures) {
  const std::span maps(textures.tables.maps.data(), textures.map_count);
  if (maps.empty()) return {};
  const std::span views(textures.tables.views.data(), maps.back().first_view + maps.back().view_count);
  const auto all = [](const auto& entries, auto holds) {
    return std::all_of(entries.begin(), entries.end(), holds);
  };

  std::string lines;
  if (all(views, [&](const ShaderView& view) { return view.form == views[0].form; }))
    lines += "#define PDSM_ONLY_FORM " + std::to_string(views[0].form) + "u\n";
  if (all(views, [](const ShaderView& view) { return view.image[2] == 1; }))
    lines += "#define PDSM_ONE_PLANE\n";
  if (all(maps, [](const ShaderMap& map) { return (map.flags & kColour) == 0; }))
    lines += "#define PDSM_GREY\n";
  if (all(views, [](const ShaderView& view) { return view.image[3] == 1; }))
    lines += "#define PDSM_ONE_LEVEL\n";
  if (all(views, [](const ShaderView& view) { return (view.flags & kOrthographic) == 0; }))
    lines += "#define PDSM_PERSPECTIVE\n";
  if (all(maps, [](const ShaderMap& map) { return map.view_count == 1; })) lines += "#define PDSM_ONE_VIEW\n";
  return lines;
}

}  // namespace pdsm
