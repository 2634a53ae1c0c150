// SPDX-License-Identifier: Apache-2.0
#include "cli/bake_options.h"

#include "cli/options.h"
#include "cli/shard_bake.h"

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

void add_resolution(CLI::App& sub, const std::string& name,
                    std::optional<std::array<std::uint32_t, 2>>& target, const std::string& help) {
  sub.add_option_function<std::string>(
         name, [name, &target](const std::string& text) { target = parse_size(name, text, kMostTexels); },
         help)
      ->type_name("R|WxH");
}

void add_quality_options(CLI::App& sub, BakeCommand& command) {
  BakeOptions& options = command.options;
  add_count(sub, "--samples", command.samples, 1, kMostSamples, "Light samples; default the light's or 256");
  add_resolution(sub, "--resolution", command.resolution, "Texels of the map; default the light's or 512");
  add_resolution(sub, "--map-resolution", command.map_resolution,
                 "Texels of each sample's shadow map; default the map's");
  add_real(sub, "--epsilon", command.epsilon, 0, kLargestEpsilon,
           "Bound of the fit; default 0.02, 0: lossless");
  add_real(sub, "--depth-tolerance", options.depth_tolerance, 0, kMostMetres,
           "Metres an event may move; default a quarter of the bias");
  add_real(sub, "--bias", options.bias, 0, kMostMetres, "Metres; default by the texels' footprint");
  add_choice(sub, "--walk", options.walk, {{"midpoint", Walk::midpoint}, {"exact", Walk::exact}},
             "How rays are converted to texels; default exact");
  add_choice(sub, "--receivers", options.receivers,
             {{"all", Receivers::all}, {"volume", Receivers::volume}, {"surfaces", Receivers::surfaces}},
             "Where functions are exact; default volume: up to the last receiver");
  add_choice(sub, "--points", options.points,
             {{"lattice", PointSet::lattice}, {"jittered", PointSet::jittered}},
             "How the light is sampled; default lattice");
  add_count(sub, "--mip-levels", options.mip_levels, 0, kMostMipLevels,
            "Levels of means for look-ups of many texels; default 0: none");
  add_count(sub, "--seed", options.seed, 0, ~std::uint64_t{0}, "Default 0");
}

void add_goal_options(CLI::App& sub, BakeCommand& command) {
  Goals& goals = command.goals;
  add_real(sub, "--target-error", goals.target_error, kLeastTarget, kMostTarget,
           "Choose samples, resolution and epsilon so that verify's mean_abs_error is at most this");
  add_real(sub, "--time-budget", goals.time_budget, kLeastSeconds, kMostSeconds,
           "Choose them for the least error in so many seconds, all lights together");
  sub.add_option_function<std::string>(
         "--size-budget",
         [&goals](const std::string& text) { goals.size_budget = parse_memory("--size-budget", text); },
         "Choose them for the least error in a file of so many bytes: 65536, 500K, 2M")
      ->type_name("SIZE");
  add_choice(sub, "--quality", command.quality,
             {{"draft", std::optional(Quality::draft)},
              {"game", std::optional(Quality::game)},
              {"final", std::optional(Quality::final)}},
             "Samples, resolution and epsilon by a name");
}

void add_resource_options(CLI::App& sub, BakeCommand& command) {
  BakeOptions& options = command.options;
  sub.add_option_function<std::string>(
         "--memory", [&options](const std::string& text) { options.memory = parse_memory("--memory", text); },
         "What baking may take beyond scene and BVH: 256M, 4G; default 4G")
      ->type_name("SIZE");
  add_count(sub, "--threads", options.threads, 0, kMostThreads, "Default 0: all processors");
  add_choice<std::string>(
      sub, "--isa", options.isa,
      {{"sse2", "sse2"}, {"sse4.2", "sse4.2"}, {"avx", "avx"}, {"avx2", "avx2"}, {"avx512", "avx512"}},
      "Instruction set that Embree may use; default the best");
  sub.add_option_function<std::string>(
         "--tile",
         [&options](const std::string& text) {
           options.tile = static_cast<std::uint32_t>(parse_count("--tile", text, kBlockSize, kMostTexels));
           if (options.tile % kBlockSize != 0) refuse_value("--tile", "a multiple of 64", text);
         },
         "Edge of a tile in texels, a multiple of 64; default by cost")
      ->type_name("N");
}

void add_verify_options(CLI::App& sub, BakeCommand& command) {
  CLI::Option* verify =
      sub.add_flag("--verify", command.verify, "Measure each map's error, as pdsm verify does");
  add_count(sub, "--verify-points", command.verify_points, 1, 100'000'000, "Points of --verify; default 4000")
      ->needs(verify);
  add_real(sub, "--max-error", command.max_error, 0, 1, "Exit 1 when a map's mean_abs_error is above it")
      ->needs(verify);
}

void add_message_options(CLI::App& sub, BakeCommand& command) {
  sub.add_flag("--quiet", command.quiet, "Nothing but errors on stderr, and what --progress asks for");
  add_choice(sub, "--progress", command.progress,
             {{"none", std::optional(ProgressStyle::none)},
              {"terminal", std::optional(ProgressStyle::terminal)},
              {"json", std::optional(ProgressStyle::json)}},
             "How progress is told on stderr; default terminal on a terminal, else none");
  sub.add_flag("--warnings-as-errors", command.warnings_as_errors,
               "Exit 3 at a warning, and write no map of it");
}

}  // namespace

ProgressStyle progress_style(const BakeCommand& command) {
  return command.progress.value_or(progress_style(command.quiet));
}

void add_bake_options(CLI::App& sub, BakeCommand& command) {
  add_file(sub, "SCENE", command.scene, "Scene file");
  sub.add_option("-o,--output", command.output,
                 "Map to write; a folder for several lights, NAME.pdsm each and manifest.json")
      ->type_name("FILE|DIR");
  sub.add_option("--light", command.light, "Bake this light; default all")->type_name("NAME");
  add_goal_options(sub, command);
  add_quality_options(sub, command);
  add_resource_options(sub, command);
  sub.add_flag("--force", command.force, "Bake maps anew that are up to date by their key");
  add_verify_options(sub, command);
  add_checkpoint_options(sub, command.checkpoint);
  sub.add_option_function<std::string>(
         "--shard", [&command](const std::string& text) { command.shard = parse_share(text); },
         "Bake the I-th of N shares of one light's map, for `pdsm merge`")
      ->type_name("I/N");
  sub.add_option("--report", command.report, "Write what the bake took")->type_name("FILE.json");
  sub.add_option("--depfile", command.depfile, "Write what was read, as make and ninja take it")
      ->type_name("FILE");
  add_message_options(sub, command);
  sub.add_flag("--dry-run", command.dry_run, "Print what the bake would take, and do not bake");
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
