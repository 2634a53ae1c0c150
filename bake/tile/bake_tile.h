// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fit/fit_rules.h"
#include "light/convex_clip.h"
#include "pdsm/bake/bake.h"
#include "tile/sample_bias.h"
#include "tile/shadow_cells.h"
#include "tile/tile_block.h"
#include "tile/tile_plan.h"
#include "trace/caster_triangles.h"
#include "trace/embree_scene.h"
#include "trace/volume_field.h"
#include "trace/volume_steps.h"

namespace pdsm {

class BlockInputs;

/// All that a tile depends on; the same for all tiles of a bake.
struct TileInput {
  const EmbreeScene& scene;
  MapGrid grid;
  std::vector<LightSample> samples;
  bool shift_law = true;  ///< all samples obey it
  Walk walk = Walk::exact;
  Receivers receivers = Receivers::volume;
  DepthBias bias;
  FitRules rules;
  std::uint32_t threads = 1;
  bool nothing_casts = false;      ///< every function is empty: trace no maps
  LightBounds light_bounds;        ///< of all samples of the bake
  double clip_depth = 0;           ///< casters before this depth are out of the hull of light and window
  double depth_rounding = 0;       ///< metres: what traced depths may be off
  const CasterTriangles& casters;  ///< that maps are made from; none: they are traced
  bool finds_cells = true;         ///< rays that nothing can darken are left out (tile/shadow_cells.h)
  /// Of a view whose samples lie out of its plane: what can block. None: the shift law holds.
  std::optional<ConvexRegion> light_hull = {};
  std::span<const VolumeField> volumes = {};  ///< that map rays march through
  VolumeSteps volume_steps = {};              ///< of `samples`, where there are volumes
  std::vector<FitRules> level_rules = {};     ///< of mip levels 1, 2, ...; none where none are made
  const BlockInputs* block_inputs = nullptr;  ///< for the keys of blocks; null: they get none

  /// Whether events are changes of transmittance (events/transmittance_events.h).
  [[nodiscard]] bool is_translucent() const { return scene.geometry().has_layers(); }
};

/// What a tile did; sums over its threads.
struct TileStatistics {
  double prepare = 0;                                   ///< wall seconds before the first sample
  double trace = 0, walk = 0, accumulate = 0, fit = 0;  ///< thread seconds
  std::uint64_t rays = 0, event_bytes = 0;
  double slope_bias_sum = 0, slope_bias_max = 0;

  void add(const TileStatistics& other);
};

/// Takes finished blocks. Called from several threads at once, once a block.
using BlockSink = std::function<void(FittedBlock&& block)>;

/// Called from one thread while a tile is baked: share done 0..1. Returns true to cancel.
using TileProgress = std::function<bool(double share)>;

enum class TileOutcome { done, events_exceeded, cancelled };

/// Bakes the functions of `tile`: a pure function of its arguments. Nothing is given to `sink` when events
/// exceed `event_limit` bytes, or would do so if all samples had as many as the first; what a cancelled tile
/// has given is incomplete.
[[nodiscard]] TileOutcome bake_tile(const TileInput& input, const TexelRect& tile, std::uint32_t strips,
                                    std::uint64_t event_limit, const BlockSink& sink,
                                    const TileProgress& progress, TileStatistics& statistics);

}  // namespace pdsm
