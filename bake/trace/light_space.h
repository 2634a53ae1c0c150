// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// One geometry of a scene, moved to light space in double and only then rounded to float: a scene far
/// from the world's origin loses nothing.
struct LightSpaceMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  bool casts = true, receives = true, closed = false;
  std::shared_ptr<const CutoutMask> mask;  ///< null: nothing is cut out
  std::vector<glm::vec2> mask_places;      ///< one a position, where there is a mask
  double opacity = 1;                      ///< above 0 where it casts
  bool has_layers = false;                 ///< in some channel, rays go on behind it with less
  bool is_coloured = false;                ///< channels differ behind it

  /// Whether all rays that meet it end there.
  [[nodiscard]] bool is_whole_caster() const { return casts && mask == nullptr && opacity == 1; }
  /// Whether they may pass through.
  [[nodiscard]] bool is_cutout_caster() const { return casts && has_holes() && opacity == 1; }
  /// Whether rays go on behind it with less.
  [[nodiscard]] bool is_translucent_caster() const { return casts && (opacity != 1 || blends()); }
  [[nodiscard]] bool blends() const { return mask != nullptr && mask->blends; }
  [[nodiscard]] bool has_holes() const { return mask != nullptr && !mask->blends; }
};

/// Around all of a caster that is no mesh (scene/caster_hull.h).
struct LightSpaceHull {
  LightSpaceMesh surface;

  /// Whether it reaches before `depth`, so that light may begin in it.
  [[nodiscard]] bool begins_before(double depth) const;
};

/// One volume of a scene, that casts, as a light sees it.
struct LightSpaceVolume {
  std::shared_ptr<const DensityGrid> grid;
  glm::dmat4 light_to_index{1.0};
  double extinction = 0;
  LightSpaceHull hull;
};

/// One set of curves, that casts, as a light sees it.
struct LightSpaceCurves {
  std::vector<glm::vec4> points;  ///< and radii
  std::vector<std::uint32_t> segments;
  CurveShape shape = CurveShape::round;
  LightSpaceHull hull;
};

/// The scene as one light sees it. Triangles with coordinates or places in a mask that are not finite are
/// left out and counted.
struct LightSpaceScene {
  std::vector<LightSpaceMesh> meshes;
  std::vector<LightSpaceVolume> volumes;
  std::vector<LightSpaceCurves> curves;
  std::uint64_t triangles = 0, dropped_triangles = 0;

  /// Whether any caster has holes.
  [[nodiscard]] bool has_cutouts() const;
  /// Whether any caster lets a part of the light through, of any channel.
  [[nodiscard]] bool has_translucency() const;
  /// Whether channels differ behind some caster.
  [[nodiscard]] bool is_coloured() const;
  /// Calls visit(const LightSpaceHull&) for that of each volume, and of all curves.
  template <typename Visit>
  void visit_hulls(Visit&& visit) const {
    for (const LightSpaceVolume& volume : volumes) visit(volume.hull);
    for (const LightSpaceCurves& of_file : curves) visit(of_file.hull);
  }
  /// Whether light samples have layers before what is opaque: casters of either kind.
  [[nodiscard]] bool has_layers() const { return has_translucency() || !volumes.empty(); }
};

/// The scene as light of `channel` (0 .. 2) meets it. Throws as check_mask(), check_volume() and
/// check_curves() do.
[[nodiscard]] LightSpaceScene to_light_space(const Scene& scene, const RigidTransform& world_to_light,
                                             std::uint32_t channel = 0);

}  // namespace pdsm
