// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/convex_clip.h"
#include "light/light_faces.h"
#include "trace/light_space.h"
#include "walk/map_grid.h"

/// What of a scene can matter for a light's map. A caster darkens a point only from the hull of the light and
/// the window (light/light_spread.h), a receiver ends a function only in the window, which the hull holds.
/// All else is left out before anything is built of the scene, so that a map can't depend on it.
namespace pdsm {

/// The hull of the light and of the grid's window up to far, widened by what texels and traced rays reach
/// beyond it.
[[nodiscard]] ConvexRegion map_reach(const LightFace& face, const MapGrid& grid);

/// Leaves out the triangles that lie on the outer side of one of the region's planes as a whole, then the
/// vertices and meshes that no triangle is left of, and volumes and curves that lie so as a whole. Order is
/// kept.
void keep_within(LightSpaceScene& scene, const ConvexRegion& region);

}  // namespace pdsm
