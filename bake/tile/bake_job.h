// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/light_faces.h"
#include "pdsm/bake/bake.h"
#include "pdsm/bake/shard.h"
#include "tile/bake_tile.h"
#include "tile/slope_limit.h"
#include "trace/caster_triangles.h"
#include "trace/embree_scene.h"
#include "trace/light_space.h"
#include "trace/volume_field.h"

namespace pdsm {

/// Which of a map's functions a setup is of.
struct ViewChannel {
  std::uint32_t view = 0, channel = 0;
};

/// What is baked, and from what: all that the functions depend on, but for the ISA. No ray has been traced
/// for it.
/// Each channel of each view of a map is a setup, and a job, of its own.
struct BakeSetup {
  BakeSetup(const Scene& scene, const Light& light, const BakeOptions& options, ViewChannel part = {});

  /// Makes the rules of the fit, with codes of depth of at least so many bits: all views of a map have one
  /// coding.
  void make_rules(std::uint32_t least_depth_bits);

  ViewChannel part;            ///< of the map
  std::uint32_t channels = 1;  ///< of the map
  bool has_emission = false;   ///< the light has a picture
  BakeOptions options;         ///< with all defaults filled in, but for the ISA
  LightFace face;              ///< the light as this view has it
  FittedView fitted;
  std::vector<LightSample> light_samples;  ///< in the space of view 0
  std::vector<LightSample> samples;        ///< the same in this view's
  MapGrid grid;
  double bias = 0;  ///< its constant part, metres
  FitRules rules;
  std::uint32_t mip_levels = 0;    ///< above 0, that are made
  std::uint32_t volume_steps = 0;  ///< of each sample; 0 without volumes
  LightSpaceScene light_space;     ///< what the light can see of the scene (trace/map_reach.h)
  double seconds_bvh = 0;          ///< of moving the scene to light space, and of the BVH where there is one
};

/// Everything between the options and the first tile, made once: besides the setup BVH, projected casters,
/// plan. Bakes and predictions start from it.
class BakeJob : public BakeSetup {
 public:
  /// The plan is of a share of the map, all else of the whole.
  BakeJob(const Scene& scene, const Light& light, const BakeOptions& options, const Share& share = {},
          ViewChannel part = {});

  /// Input of the tiles; `sample_stride` > 1 takes only every so manieth sample, for a trial.
  [[nodiscard]] TileInput tile_input(std::uint32_t sample_stride = 1) const;

  /// What all maps have in common of their bias.
  [[nodiscard]] DepthBias depth_bias() const { return {bias, slope_limit.from}; }

  /// Whether any function may be other than empty.
  [[nodiscard]] bool has_shadows() const;

  /// Whether all samples obey the shift law (walk/ray_path.h), so that one walk serves all rays of each.
  [[nodiscard]] bool shift_law() const;

  /// Whether rays that nothing can darken are left out.
  [[nodiscard]] bool finds_cells() const;

  SlopeLimit slope_limit;
  TilePlan plan;
  std::unique_ptr<EmbreeScene> embree;
  CasterTriangles casters;  ///< none where maps are traced
  std::vector<VolumeField> volumes;
  std::uint64_t resident_after_bvh = 0;
};

}  // namespace pdsm
