// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pdsm/bake/scene.h"
#include "pdsm/bake/view_fit.h"
#include "pdsm/format/map_file.h"
#include "pdsm/format/penumbra_map.h"

/// Baking of one light's penumbra deep shadow map.
/// Paper: Saint-Amour, Paquette, Poulin, "Penumbra Deep Shadow Maps", 2004; docs/maths.md has ours.
namespace pdsm {

class Checkpoint;

/// How a PDSM ray is converted to texels of a sample's shadow map (docs/maths.md, "The two walks").
enum class Walk {
  midpoint,  ///< the thesis' 8-connected midpoint line: one texel a major step
  exact      ///< every texel that the ray crosses
};

/// Where functions are exact (docs/maths.md, "Domain").
enum class Receivers {
  all,      ///< from near to far, everywhere
  volume,   ///< from near to the last light-facing receiver surface on each ray
  surfaces  ///< near the scene's own surfaces only: smaller, but nothing else can receive
};

/// How the light is sampled; any number of samples.
enum class PointSet {
  lattice,  ///< Fibonacci lattice (rect) or sunflower (disk, distant): i/N and the golden ratio
  jittered  ///< the thesis' stratified jitter
};

/// Levels above 0 that a mip chain may have: one texel of the last is one block, so that a level's texel
/// never needs the functions of two.
inline constexpr std::uint32_t kMostMipLevels = 6;
static_assert(1U << kMostMipLevels == kBlockSize);

struct BakeOptions {
  std::uint32_t samples = 256;                  ///< N, 1 .. 65536
  std::uint32_t width = 512, height = 512;      ///< texels of the map, 1 .. 16384
  std::uint32_t map_width = 0, map_height = 0;  ///< texels of each sample map over the window; 0: the map's.
                                                ///< Rounded to a multiple or an integer fraction.
  double epsilon = 0.02;                        ///< bound of the fit, 0 (lossless) <= epsilon < 1
  std::optional<double> depth_tolerance;        ///< delta, metres >= 0; default a quarter of the bias
  std::optional<double> bias;                   ///< metres >= 0; default from the texel footprint
  Walk walk = Walk::exact;
  Receivers receivers = Receivers::volume;
  PointSet points = PointSet::lattice;
  std::uint32_t mip_levels = 0;   ///< levels above 0 (penumbra_map.h, FunctionImage), 0 .. kMostMipLevels;
                                  ///< no more are made than the map's smaller side can be halved
  bool unrounded_values = false;  ///< for measuring: the same pieces, values in 1/256 of the codes they had
  /// For measuring: steps in which a light sample's ray loses its light in volumes, 1 .. 256. 0: as epsilon
  /// and N need (docs/maths.md, "Volumes").
  std::uint32_t volume_steps = 0;
  std::uint64_t memory = std::uint64_t{4} << 30;  ///< bytes that baking may take beyond scene and BVH
  std::uint32_t threads = 0;                      ///< 0: all processors
  std::uint64_t seed = 0;
  /// Replaces `samples`, `points` and `seed` when not empty: any points in light space, also out of its
  /// plane (z < near), or for a distant light any directions of its rays (z = 1); equal weights.
  std::vector<LightSample> light_samples;
  /// Whether the map gets block keys (penumbra_map.h), for later bakes to take blocks over from it: where
  /// sample maps are projected, and of blocks without limited slopes. Nothing else depends on it.
  bool block_keys = false;
  /// A map file of before, of any origin; empty: none. Blocks that it has block keys of, and that would come
  /// out the same, are taken from it instead of being baked. What is damaged, or of other options, is baked;
  /// the result is the same with and without. The file may be the one that the result replaces later.
  std::filesystem::path previous;
  std::string isa;         ///< Embree's: sse2, sse4.2, avx, avx2, avx512; empty: best
  std::uint32_t tile = 0;  ///< edge of a tile in texels, multiple of 64; 0: by cost
};

/// How far a bake is. Told from the thread that called bake(), a few times a second.
struct BakeProgress {
  std::string step;            ///< "bvh", "trace", "fit", ...
  double done = 0;             ///< 0..1 of the whole bake
  double rays_per_second = 0;  ///< so far; 0 while unknown
};

/// Reason why something was modelled or left out.
struct ModelledFeature {
  std::string feature;  ///< "opaque casters", "volumes", "general scan conversion", ...
  bool modelled = false;
  std::string reason;  ///< one clause
  std::string saved;   ///< what leaving it out saved: a number and of what; empty where nothing can be said
};

/// What a bake did. Seconds are wall-clock; trace, walk, accumulate and fit are shares of the thread time,
/// which of a bake that was gone on with are those of all its runs, where the total is of the last.
struct BakeReport {
  double seconds_bvh = 0, seconds_trace = 0, seconds_walk = 0, seconds_accumulate = 0, seconds_fit = 0,
         seconds_total = 0;
  std::uint64_t rays = 0, events = 0, tiles = 0;
  std::uint64_t texels = 0, pieces = 0, empty_texels = 0;  ///< of level 0
  std::uint32_t mip_levels = 0;                            ///< above 0, that were made
  std::uint64_t blocks = 0;                                ///< of level 0
  std::uint64_t blocks_taken_over = 0;                     ///< of these, from BakeOptions::previous
  std::uint64_t peak_event_bytes = 0;
  std::uint64_t resident_after_bvh = 0;  ///< bytes resident in memory when the BVH stood
  std::uint32_t map_width = 0, map_height = 0, samples = 0, tile = 0;
  double epsilon = 0, depth_tolerance = 0, bias = 0;
  double mean_slope_bias = 0, max_slope_bias = 0;  ///< metres added per map texel for its slope
  Walk walk = Walk::exact;
  std::string isa;
  std::string key;  ///< as map_key() tells it (map_key.h)
  std::vector<ModelledFeature> modelled;
  std::vector<std::string> warnings;
};

/// What a bake will take. From a trial with a few samples; times are of this machine.
struct BakePrediction {
  std::uint64_t rays = 0, events = 0;
  std::uint64_t memory_bytes = 0;  ///< beyond scene and BVH, as BakeOptions::memory limits it
  std::uint64_t scene_bytes = 0;   ///< bytes resident when the BVH stood, of all that the process has
  double seconds = 0;
  std::uint32_t tile = 0, tiles = 0;
};

struct BakeCallbacks {
  std::function<void(const BakeProgress&)> progress;  ///< may be empty
  std::function<bool()> cancelled;                    ///< polled; true ends the bake with Error(interrupted)
};

/// A baked map: image n is level n. `map.images[n].blocks` are empty and `blocks[n]` holds them encoded,
/// ready for write_encoded_map; decode_blocks() fills the map in.
struct BakedMap {
  PenumbraMap map;
  std::vector<std::vector<EncodedBlock>> blocks;
  FittedView fitted;  ///< of several views the first; `nothing_...` of all
  BakeReport report;
};

/// Bakes `light` of `scene`. The result depends on the arguments and the ISA alone, whatever the number of
/// threads, the tile and the memory. Throws Error (usage) "--option: reason" for options out of range,
/// (input) for what the scene makes impossible, (resource) when `memory` can't be met, (interrupted).
/// One bake uses `options.threads` threads; several bakes at once are safe. With a `checkpoint`
/// (checkpoint.h), a bake that did not come to its end is gone on with, to the same result.
[[nodiscard]] BakedMap bake(const Scene& scene, const Light& light, const BakeOptions& options,
                            const BakeCallbacks& callbacks = {}, Checkpoint* checkpoint = nullptr);

/// What bake() with the same arguments, and no map of before, would take. Same faults.
[[nodiscard]] BakePrediction predict_bake(const Scene& scene, const Light& light, const BakeOptions& options);

/// The decoded map of a bake.
[[nodiscard]] PenumbraMap decode_blocks(const BakedMap& baked);

/// The light samples of a bake: positions in light space (of a distant light the directions of its rays,
/// z = 1), weights, jitter of the map grids. Pure.
[[nodiscard]] std::vector<LightSample> make_light_samples(const Light& light, std::uint32_t count,
                                                          PointSet points, std::uint64_t seed);

}  // namespace pdsm
