// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pdsm/bake/bake.h"
#include "pdsm/bake/shard.h"
#include "tile/bake_tile.h"
#include "tile/slope_limit.h"
#include "trace/caster_triangles.h"
#include "trace/embree_scene.h"
#include "trace/light_space.h"

namespace pdsm {

/// Everything between the options and the first tile, made once: light-space scene, BVH, samples, view,
/// grid, bias, fit rules, plan. Bakes and predictions start from it.
class BakeJob {
 public:
  /// The plan is of a share of the map, all else of the whole.
  BakeJob(const Scene& scene, const Light& light, const BakeOptions& options, const Share& share = {});

  /// Input of the tiles; `sample_stride` > 1 takes only every so manieth sample, for a trial.
  [[nodiscard]] TileInput tile_input(std::uint32_t sample_stride = 1) const;

  /// What all maps have in common of their bias.
  [[nodiscard]] DepthBias depth_bias() const { return {bias, slope_limit.from}; }

  /// Whether any function may be other than empty.
  [[nodiscard]] bool has_shadows() const;

  /// Whether all samples obey the shift law (walk/ray_path.h), so that one walk serves all rays of each.
  [[nodiscard]] bool shift_law() const;

  BakeOptions options;  ///< with all defaults filled in
  FittedView fitted;
  std::vector<LightSample> samples;
  MapGrid grid;
  double bias = 0;  ///< its constant part, metres
  SlopeLimit slope_limit;
  FitRules rules;
  std::uint32_t mip_levels = 0;  ///< above 0, that are made
  TilePlan plan;
  LightSpaceScene light_space;
  std::unique_ptr<EmbreeScene> embree;
  CasterTriangles casters;  ///< none where maps are traced
  double seconds_bvh = 0;
  std::uint64_t resident_after_bvh = 0;
};

}  // namespace pdsm
