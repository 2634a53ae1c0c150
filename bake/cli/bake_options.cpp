// SPDX-License-Identifier: Apache-2.0
#include "cli/bake_options.h"

#include "cli/options.h"
#include "cli/shard_bake.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Metres that no scene reaches.
constexpr double kMostMetres = 1e9;
constexpr std::uint32_t kMostThreads = 1024;
/// Below the least target, errors drown in those of the shadow rays that they are measured against; 1 is all
/// that an attenuation can err.
constexpr double kLeastTarget = 0.0005, kMostTarget = 1;
constexpr double kLeastSeconds = 0.001, kMostSeconds = 1e7;
constexpr double kLargestEpsilon = 1 - 0x1p-53;

void add_resolution(Options& takes, const std::string& name,
                    std::optional<std::array<std::uint32_t, 2>>& target, const std::string& help) {
  takes.value(
      name, "R|WxH",
      [name, &target](const std::string& text) { target = parse_size(name, text, kMostTexels); }, help);
}

void add_quality_options(Options& takes, BakeCommand& command) {
  BakeOptions& options = command.options;
  takes.count("--samples", command.samples, 1, kMostSamples, "Light samples; default the light's or 256");
  add_resolution(takes, "--resolution", command.resolution, "Texels of the map; default the light's or 512");
  add_resolution(takes, "--map-resolution", command.map_resolution,
                 "Texels of each sample's shadow map; default the map's");
  takes.real("--epsilon", command.epsilon, 0, kLargestEpsilon, "Bound of the fit; default 0.02, 0: lossless");
  takes.real("--depth-tolerance", options.depth_tolerance, 0, kMostMetres,
             "Metres an event may move; default a quarter of the bias");
  takes.real("--bias", options.bias, 0, kMostMetres, "Metres; default by the texels' footprint");
  takes.choice("--walk", options.walk, {{"midpoint", Walk::midpoint}, {"exact", Walk::exact}},
               "How rays are converted to texels; default exact");
  takes.choice("--receivers", options.receivers,
               {{"all", Receivers::all}, {"volume", Receivers::volume}, {"surfaces", Receivers::surfaces}},
               "Where functions are exact; default volume: up to the last receiver");
  takes.choice("--points", options.points, {{"lattice", PointSet::lattice}, {"jittered", PointSet::jittered}},
               "How the light is sampled; default lattice");
  takes.count("--mip-levels", options.mip_levels, 0, kMostMipLevels,
              "Levels of means for look-ups of many texels; default 0: none");
  takes.count("--seed", options.seed, 0, ~std::uint64_t{0}, "Default 0");
}

void add_goal_options(Options& takes, BakeCommand& command) {
  Goals& goals = command.goals;
  takes.real("--target-error", goals.target_error, kLeastTarget, kMostTarget,
             "Choose samples, resolution and epsilon so that verify's mean_abs_error is at most this");
  takes.real("--time-budget", goals.time_budget, kLeastSeconds, kMostSeconds,
             "Choose them for the least error in so many seconds, all lights together");
  takes.memory("--size-budget", goals.size_budget,
               "Choose them for the least error in a file of so many bytes: 65536, 500K, 2M");
  takes.choice("--quality", command.quality,
               {{"draft", std::optional(Quality::draft)},
                {"game", std::optional(Quality::game)},
                {"final", std::optional(Quality::final)}},
               "Samples, resolution and epsilon by a name");
}

void add_resource_options(Options& takes, BakeCommand& command) {
  BakeOptions& options = command.options;
  takes.memory("--memory", options.memory, "What baking may take beyond scene and BVH: 256M, 4G; default 4G");
  takes.count("--threads", options.threads, 0, kMostThreads, "Default 0: all processors");
  takes.choice<std::string>(
      "--isa", options.isa,
      {{"sse2", "sse2"}, {"sse4.2", "sse4.2"}, {"avx", "avx"}, {"avx2", "avx2"}, {"avx512", "avx512"}},
      "Instruction set that Embree may use; default the best");
  takes.value(
      "--tile", "N",
      [&options](const std::string& text) {
        options.tile = static_cast<std::uint32_t>(parse_count("--tile", text, kBlockSize, kMostTexels));
        if (options.tile % kBlockSize != 0) refuse_value("--tile", "a multiple of 64", text);
      },
      "Edge of a tile in texels, a multiple of 64; default by cost");
}

void add_verify_options(Options& takes, BakeCommand& command) {
  const Option verify =
      takes.flag("--verify", command.verify, "Measure each map's error, as pdsm verify does");
  takes.count("--verify-points", command.verify_points, 1, 100'000'000, "Points of --verify; default 4000")
      .needs(verify);
  takes.real("--max-error", command.max_error, 0, 1, "Exit 1 when a map's mean_abs_error is above it")
      .needs(verify);
}

void add_message_options(Options& takes, BakeCommand& command) {
  takes.flag("--quiet", command.quiet, "Nothing but errors on stderr, and what --progress asks for");
  takes.choice("--progress", command.progress,
               {{"none", std::optional(ProgressStyle::none)},
                {"terminal", std::optional(ProgressStyle::terminal)},
                {"json", std::optional(ProgressStyle::json)}},
               "How progress is told on stderr; default terminal on a terminal, else none");
  takes.flag("--warnings-as-errors", command.warnings_as_errors,
             "Exit 3 at a warning, and write no map of it");
}

}  // namespace

ProgressStyle progress_style(const BakeCommand& command) {
  return command.progress.value_or(progress_style(command.quiet));
}

void add_bake_options(Options& takes, BakeCommand& command) {
  takes.file("SCENE", command.scene, "Scene file");
  takes.text("-o,--output", "FILE|DIR", command.output,
             "Map to write; a folder for several lights, NAME.pdsm each and manifest.json");
  takes.text("--light", "NAME", command.light, "Bake this light; default all");
  add_goal_options(takes, command);
  add_quality_options(takes, command);
  add_resource_options(takes, command);
  takes.flag("--force", command.force, "Bake maps anew that are up to date by their key");
  add_verify_options(takes, command);
  add_checkpoint_options(takes, command.checkpoint);
  takes.value(
      "--shard", "I/N", [&command](const std::string& text) { command.shard = parse_share(text); },
      "Bake the I-th of N shares of one light's map, for `pdsm merge`");
  takes.text("--report", "FILE.json", command.report, "Write what the bake took");
  takes.text("--depfile", "FILE", command.depfile, "Write what was read, as make and ninja take it");
  add_message_options(takes, command);
  takes.flag("--dry-run", command.dry_run, "Print what the bake would take, and do not bake");
}

BakeOptions options_for(const BakeCommand& command, const Light& light) {
  BakeOptions options = command.options;
  auto samples = command.samples;
  auto resolution = command.resolution;
  if (command.quality) {
    options = with_settings(options, quality_settings(*command.quality));
  } else if (!command.goals.any()) {
    if (!samples) samples = light.samples;
    if (!resolution) resolution = light.resolution;
  }
  options.samples = samples.value_or(options.samples);
  options.epsilon = command.epsilon.value_or(options.epsilon);
  if (resolution) std::tie(options.width, options.height) = std::tuple((*resolution)[0], (*resolution)[1]);
  if (command.map_resolution) {
    options.map_width = (*command.map_resolution)[0];
    options.map_height = (*command.map_resolution)[1];
  }
  return options;
}

FixedOptions fixed_options(const BakeCommand& command) {
  return {command.samples.has_value(), command.resolution.has_value(), command.epsilon.has_value(),
          command.map_resolution.has_value()};
}

void check_goals(const BakeCommand& command) {
  if (!command.goals.any()) return;
  if (command.quality) {
    throw Error(Failure::usage, "--quality", "names the options that a goal would choose: give one of both");
  }
  if (command.dry_run) {
    throw Error(Failure::usage, "--dry-run", "can't tell what a goal leads to: that takes bakes");
  }
}

}  // namespace pdsm
