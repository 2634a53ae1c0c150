// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/options.h"
#include "cli/recorded_options.h"
#include "cli/scene_change.h"
#include "cli/streams.h"
#include "cli/verify_report.h"
#include "evaluate/light_model.h"
#include "evaluate/window_errors.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

struct VerifyCommand {
  std::string map, scene, heat_map;
  VerifyOptions options;
  std::uint32_t heat_map_samples = 256;
  std::optional<double> max_error;
  bool json = false, no_budget = false;
};

/// Whether the map's own record says that it is exact on surfaces alone.
bool is_for_surfaces(const PenumbraMap& map) {
  const nlohmann::ordered_json metadata = metadata_of(map);
  const auto options = metadata.find("options");
  return options != metadata.end() && options->is_object() && options->value("receivers", "") == "surfaces";
}

/// Maps of several views or channels, for which there is no budget.
bool has_many_jobs(const PenumbraMap& map) {
  return map.views.size() > 1 || map.channels > 1;
}

/// What the budget needs for baking again; nothing with --no-budget.
std::optional<BakeOptions> options_for_budget(const VerifyCommand& command, const PenumbraMap& map,
                                              const Scene& scene, const Light& light) {
  if (command.no_budget || has_many_jobs(map)) return std::nullopt;
  const auto refuse = [&command](const std::string& field, const std::string& reason) {
    throw Error(Failure::input, command.map + ":" + field, reason + ": only --no-budget can measure it");
  };
  if (changed_since_bake(scene, light, map)) refuse("key", "the scene has changed since the bake");
  std::optional<BakeOptions> options = recorded_options(map, light);
  if (!options) refuse("options", "the map does not tell how it was baked");
  return options;
}

/// Atty et al.'s error takes as many texels of the window as points.
double measure_atty_error(const PenumbraMap& map, const Scene& scene, const Light& light,
                          const VerifyOptions& options) {
  const auto views = static_cast<std::uint32_t>(map.views.size());
  std::vector<TexelError> errors;
  for (std::uint32_t view = 0; view < views; ++view) {
    const auto texels =
        draw_texels(map.views[view], std::max(1U, options.points / views), options.seed + view);
    const auto of_view = measure_texels(map, scene, light, texels, options.samples, options.seed, view);
    errors.insert(errors.end(), of_view.begin(), of_view.end());
  }
  return atty_error(errors);
}

void write_heat_map(const VerifyCommand& command, const PenumbraMap& map, const Scene& scene,
                    const Light& light) {
  const View& view = map.views.front();
  const std::vector<TexelError> errors =
      measure_texels(map, scene, light, all_texels(view), command.heat_map_samples, command.options.seed);
  if (image_format(command.heat_map, "--heat-map") == ImageFormat::png)
    write_png(draw_window_errors(view.width, view.height, errors), command.heat_map);
  else
    write_exr(view.width, view.height, {window_error_plane(view.width, view.height, errors)},
              command.heat_map);
}

/// Sees that the picture can be written, before anything is measured for it.
void check_heat_map(const VerifyCommand& command) {
  if (command.heat_map.empty()) return;
  (void)image_format(command.heat_map, "--heat-map");
  std::vector<std::filesystem::path> inputs = scene_inputs(command.scene);
  inputs.emplace_back(command.map);
  check_output(command.heat_map, inputs);
}

int run_verify(const VerifyCommand& command) {
  check_heat_map(command);
  const PenumbraMap map = read_map(command.map);
  const Scene scene = read_scene(command.scene);
  const Light& light = light_of_map(scene, map, 0, command.map);
  if (!command.heat_map.empty() && map.views.size() > 1)
    throw Error(Failure::usage, "--heat-map", "only maps of one view have a window to draw");
  if (command.no_budget || has_many_jobs(map)) warn_if_changed(scene, light, map, command.map);
  const std::optional<BakeOptions> bake_options = options_for_budget(command, map, scene, light);
  VerifyOptions options = command.options;
  options.free_space = !is_for_surfaces(map);
  const ProbedTruth truth = probe_truth(map, scene, light, options);
  VerifyReport report{verify(map, truth), measure_atty_error(map, scene, light, options), {}, {}};
  if (report.result.points < options.points) {
    write_warning(
        fmt::format("only {} of {} points found in the window", report.result.points, options.points));
  }
  if (is_body(light) && !command.no_budget) report.light = measure_light_model(scene, light, truth, options);
  if (bake_options) report.budget = measure_error_budget(map, scene, light, *bake_options, truth);
  if (!command.heat_map.empty()) write_heat_map(command, map, scene, light);
  write_result(command.json ? verify_json(report) : verify_text(report));
  const bool holds = !command.max_error || report.result.mean_abs_error <= *command.max_error;
  return holds ? kExitOk : kExitDoesNotHold;
}

}  // namespace

void add_verify_command(CommandLine& line) {
  auto command = std::make_shared<VerifyCommand>();
  Options takes = line.add_command("verify", "Error of a map against shadow rays, and what it is made of",
                                   [command] { return run_verify(*command); });
  takes.file("FILE", command->map, "Map");
  takes.file("SCENE", command->scene, "Scene file that it was baked from");
  takes.count("--points", command->options.points, 1, 100'000'000,
              "Points, half on surfaces and half in free space; default 4000");
  takes.count("--samples", command->options.samples, 2, std::uint64_t{1} << 24,
              "Shadow rays a point; default 4096");
  takes.count("--seed", command->options.seed, 0, ~std::uint64_t{0}, "Other points; default 0");
  takes.real("--max-error", command->max_error, 0, 1, "Exit 1 when mean_abs_error is above it");
  takes.flag("--no-budget", command->no_budget, "Leave the error budget out, which takes two bakes");
  takes.text("--heat-map", "IMAGE.png|.exr", command->heat_map,
             "Write |error| over the window; EXR: look-up - truth, signed");
  takes.count("--heat-map-samples", command->heat_map_samples, 1, std::uint64_t{1} << 24,
              "Shadow rays a texel of the heat map; default 256");
  takes.flag("--json", command->json, "Print JSON");
}

}  // namespace pdsm
