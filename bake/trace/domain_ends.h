// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "trace/embree_scene.h"
#include "trace/sample_map.h"

namespace pdsm {

/// Depth of the last light-facing receiver surface on the PDSM ray of each texel of `rect` (texels of the
/// map, row by row), +infinity where there is none. On closed meshes the winding tells what faces the
/// light; on open ones every surface counts. The depth is that of the triangle's plane on the ray in
/// double, not a traced distance. Any thread.
void find_domain_ends(const EmbreeScene& scene, const MapGrid& grid, const TexelRect& rect,
                      std::span<float> ends);

}  // namespace pdsm
