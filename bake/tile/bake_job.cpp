// SPDX-License-Identifier: Apache-2.0
#include "tile/bake_job.h"

#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>

#include "events/transmittance_events.h"
#include "light/fit_face.h"
#include "pdsm/format/error.h"
#include "scene/scene_channels.h"
#include "tile/share_rect.h"
#include "trace/map_rays.h"
#include "trace/map_reach.h"
#include "walk/ray_path.h"

namespace pdsm {
namespace {

/// Allowance for the rounding of traced depths, as a share of far: 16 float steps.
constexpr double kDepthRounding = 0x1.0p-20;
/// The default bias in map texel footprints at far. The slope of each hit is allowed for by itself, so this
/// only has to hold the depth tolerance and what curved surfaces add.
constexpr double kBiasFootprints = 0.25;
/// The default depth tolerance as a share of the bias.
constexpr double kToleranceShare = 0.25;
/// A fitted near is at least this share of far (view_fit.h).
constexpr double kNearFloor = 1e-4;
constexpr double kClipSlack = 1e-5;
/// Translucent surfaces that a ray may meet; a tile that needs more memory than its plan's takes it.
constexpr std::uint32_t kExpectedSurfaces = 4;
constexpr std::uint32_t kMostSamples = 65536, kMostTexels = 16384;

void require(bool holds, const char* option, const std::string& reason) {
  if (!holds) throw Error(Failure::usage, option, reason);
}

bool is_length(const std::optional<double>& x) {
  return !x || (std::isfinite(*x) && *x >= 0);
}

void check_options(const BakeOptions& o) {
  const auto is_size = [](std::uint32_t n) { return n >= 1 && n <= kMostTexels; };
  require(o.samples >= 1 && o.samples <= kMostSamples, "--samples", "must be from 1 to 65536");
  require(o.light_samples.size() <= kMostSamples, "--samples", "must be from 1 to 65536");
  require(is_size(o.width) && is_size(o.height), "--resolution", "must be from 1 to 16384 texels");
  require(is_size(o.map_width) && is_size(o.map_height), "--map-resolution",
          "must be from 1 to 16384 texels");
  require(o.epsilon >= 0 && o.epsilon < 1, "--epsilon", "must be from 0 to below 1");
  require(is_length(o.depth_tolerance), "--depth-tolerance", "must be 0 or more metres");
  require(is_length(o.bias), "--bias", "must be 0 or more metres");
  require(o.tile % kBlockSize == 0, "--tile", "must be a multiple of 64");
  require(o.threads <= 1024, "--threads", "must be at most 1024");
  require(o.volume_steps <= kMostVolumeSteps, "volume steps", "must be from 0 to 256");
  require(o.mip_levels <= kMostMipLevels, "--mip-levels", "must be from 0 to 6");
}

BakeOptions fill_in(BakeOptions o) {
  if (o.map_width == 0) o.map_width = o.width;
  if (o.map_height == 0) o.map_height = o.height;
  check_options(o);
  if (o.threads == 0) o.threads = static_cast<std::uint32_t>(std::max(1, omp_get_num_procs()));
  if (!o.light_samples.empty()) o.samples = static_cast<std::uint32_t>(o.light_samples.size());
  // More threads than tasks would only take memory.
  o.threads = std::min(o.threads, std::max(o.samples, blocks_along(o.width) * blocks_along(o.height)));
  return o;
}

/// Levels above 0 that are made: as many as are asked for and as the smallest side of all views can be
/// halved.
std::uint32_t count_mip_levels(const Light& light, const BakeOptions& o) {
  const LightFace last = light_face(light, view_count(light) - 1, o.width, o.height);
  const std::uint32_t side = std::min(last.width, last.height);
  return std::min(o.mip_levels, static_cast<std::uint32_t>(std::bit_width(side) - 1));
}

/// The grid of a view whose texels have as many map texels as the first view's.
MapGrid make_face_grid(const LightFace& face, const View& view, const BakeOptions& o) {
  const auto map_texels = [](std::uint32_t of_map, std::uint32_t of_first, std::uint32_t of_view) {
    return static_cast<std::uint32_t>(std::lround(static_cast<double>(of_map) / of_first * of_view));
  };
  MapGrid grid = make_map_grid(view, map_texels(o.map_width, o.width, view.width),
                               map_texels(o.map_height, o.height, view.height));
  grid.is_one_of_several = face.is_one_of_several;
  return grid;
}

std::vector<LightSample> turn_samples(const LightFace& face, std::vector<LightSample> samples) {
  if (face.is_one_of_several)
    for (LightSample& sample : samples) sample.position = face.from_light(sample.position);
  return samples;
}

std::uint64_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void check_samples(const std::vector<LightSample>& samples, const View& view) {
  for (const LightSample& sample : samples) {
    const bool distant = view.projection == Projection::orthographic;
    const double z = sample.position[2];
    const bool good = std::isfinite(sample.position[0]) && std::isfinite(sample.position[1]) &&
                      std::isfinite(z) && (distant ? z == 1 : z < view.near_depth);
    require(good, "light samples",
            distant ? "must be finite directions with z = 1" : "must be finite and in front of near");
  }
}

/// Depth before which no caster is in the way. A fitted near is the nearest caster's in the hull, unless it
/// was raised to its floor; before any other near, casters still count.
double caster_clip_depth(const FittedView& fitted, const LightFace& face, bool own_samples) {
  const bool distant = fitted.view.projection == Projection::orthographic;
  const double near = fitted.view.near_depth, floor = distant ? 0 : kNearFloor * fitted.view.far_depth;
  const double emitter = distant ? 0 : kEmitterShare * near;
  // Samples that the caller brings may lie outside the light's shape, and so outside the hull.
  if (own_samples) return emitter;
  if (face.reach[2] > 0) return -face.reach[2];
  return fitted.near_fitted && near > floor * (1 + kClipSlack) ? near * (1 - kClipSlack) : emitter;
}

/// A share of the map texel footprint at far, the larger of both axes.
double default_bias(const MapGrid& grid) {
  return kBiasFootprints * std::max(grid.pitch[0], grid.pitch[1]) * grid.spread_at(grid.far_depth);
}

std::vector<LightSample> choose_samples(const Light& light, const BakeOptions& options,
                                        std::uint32_t channel) {
  if (!options.light_samples.empty()) return options.light_samples;
  return make_light_samples(channel_light(light, channel), options.samples, options.points, options.seed);
}

/// Layers that a map texel may have, about: of surfaces, then of volumes.
std::uint32_t count_layers(const BakeSetup& setup) {
  return (setup.light_space.has_translucency() ? kExpectedSurfaces : 0) + setup.volume_steps;
}

}  // namespace

BakeSetup::BakeSetup(const Scene& scene, const Light& light, const BakeOptions& wanted, ViewChannel of_map)
    : part(of_map),
      has_emission(light.emission != nullptr),
      options(fill_in(wanted)),
      face(light_face(light, part.view, options.width, options.height)),
      fitted(fit_face(scene, face)),
      light_samples(choose_samples(light, options, part.channel)),
      samples(turn_samples(face, light_samples)),
      grid(make_face_grid(face, fitted.view, options)) {
  check_samples(samples, fitted.view);
  bias = std::max(options.bias.value_or(default_bias(grid)), kDepthRounding * grid.far_depth);
  mip_levels = count_mip_levels(light, options);
  const double start = omp_get_wtime();
  light_space = to_light_space(scene, fitted.view.world_to_view, part.channel);
  // Samples that the caller brings may lie outside the light's shape, and see more.
  if (options.light_samples.empty()) keep_within(light_space, map_reach(face, grid));
  seconds_bvh = omp_get_wtime() - start;
  const bool has_layers = light_space.has_layers();
  require(
      !has_layers || !is_lossless(options.epsilon), "--epsilon",
      "too small for translucent casters and volumes, whose values are no counts: must be 3.1e-5 or more");
  if (!light_space.volumes.empty())
    volume_steps = options.volume_steps != 0 ? options.volume_steps
                                             : choose_volume_steps(options.epsilon, options.samples);
  make_rules(16);
}

void BakeSetup::make_rules(std::uint32_t least_depth_bits) {
  rules = make_fit_rules(
      fitted.view, options.samples, options.epsilon, options.depth_tolerance.value_or(kToleranceShare * bias),
      light_space.has_layers() ? transmittance_unit(options.samples) : 1, least_depth_bits);
  if (options.unrounded_values) write_unrounded(rules);
}

BakeJob::BakeJob(const Scene& scene, const Light& light, const BakeOptions& wanted, const Share& share,
                 ViewChannel of_map)
    : BakeSetup(scene, light, wanted, of_map) {
  options.isa = choose_isa(options.isa);
  plan = plan_tiles({grid, samples, options.walk, options.threads, options.memory, options.tile, mip_levels,
                     share_rect(grid, share), count_layers(*this)});
  const double start = omp_get_wtime();
  embree = std::make_unique<EmbreeScene>(light_space, options.isa, options.threads);
  seconds_bvh += omp_get_wtime() - start;
  if (has_shadows()) slope_limit = find_slope_limit(*embree, grid, options.walk, bias, options.threads);
  if (has_shadows() && shift_law() && grid.perspective())
    casters = project_casters(light_space, grid, bound_samples(samples),
                              first_caster_depth(grid, samples.front()), options.threads);
  for (const LightSpaceVolume& volume : light_space.volumes) volumes.emplace_back(volume);
  resident_after_bvh = resident_bytes();
}

TileInput BakeJob::tile_input(std::uint32_t sample_stride) const {
  TileInput input{*embree,
                  grid,
                  {},
                  shift_law(),
                  options.walk,
                  options.receivers,
                  depth_bias(),
                  rules,
                  options.threads,
                  !has_shadows(),
                  bound_samples(samples),
                  caster_clip_depth(fitted, face, !options.light_samples.empty()),
                  kDepthRounding * grid.far_depth,
                  casters};
  input.volumes = volumes;
  input.finds_cells = finds_cells();
  if (!shift_law() && finds_cells()) input.light_hull = map_reach(face, grid);
  for (std::uint32_t level = 1; level <= mip_levels; ++level)
    input.level_rules.push_back(make_level_rules(rules, level));
  for (std::size_t n = 0; n < samples.size(); n += sample_stride) input.samples.push_back(samples[n]);
  input.volume_steps = VolumeSteps(volume_steps, static_cast<std::uint32_t>(input.samples.size()));
  return input;
}

bool BakeJob::has_shadows() const {
  // Samples that the caller brings may see casters that the light's shape does not.
  return !fitted.nothing_casts || !options.light_samples.empty();
}

bool BakeJob::finds_cells() const {
  // Samples out of the plane that the caller brings may see casters from anywhere.
  return shift_law() || options.light_samples.empty();
}

bool BakeJob::shift_law() const {
  return std::all_of(samples.begin(), samples.end(),
                     [this](const LightSample& sample) { return obeys_shift_law(grid, sample); });
}

}  // namespace pdsm
