// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/options.h"
#include "cli/streams.h"
#include "evaluate/verify.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

struct VerifyCommand {
  std::string map, scene;
  VerifyOptions options;
  std::optional<double> max_error;
  bool json = false;
};

std::string as_json(const VerifyResult& result) {
  nlohmann::ordered_json json;
  json["points"] = result.points;
  json["shadowed_points"] = result.shadowed_points;
  json["mean_abs_error"] = result.mean_abs_error;
  json["rms_error"] = result.rms_error;
  json["p99_error"] = result.p99_error;
  json["max_error"] = result.max_error;
  json["bias"] = result.bias;
  json["truth_standard_error"] = result.truth_standard_error;
  json["past_end"] = result.past_end;
  return json.dump(2) + "\n";
}

std::string as_text(const VerifyResult& result) {
  return fmt::format(
      "points                {} ({} on surfaces, {} in shadow, {} past the end)\n"
      "mean abs error        {:.5f} (on surfaces {:.5f}, in free space {:.5f})\n"
      "rms error             {:.5f}\n"
      "p99 error             {:.5f}\n"
      "max error             {:.5f}\n"
      "bias                  {:+.5f}\n"
      "truth standard error  {:.5f}\n",
      result.points, result.surface_points, result.shadowed_points, result.past_end, result.mean_abs_error,
      result.surface_error, result.free_error, result.rms_error, result.p99_error, result.max_error,
      result.bias, result.truth_standard_error);
}

/// Whether the map's own record says that it is exact on surfaces alone.
bool is_for_surfaces(const PenumbraMap& map) {
  const nlohmann::ordered_json metadata = metadata_of(map);
  const auto options = metadata.find("options");
  return options != metadata.end() && options->is_object() && options->value("receivers", "") == "surfaces";
}

int run_verify(const VerifyCommand& command) {
  const PenumbraMap map = read_map(command.map);
  const Scene scene = read_scene(command.scene);
  const Light& light = light_of_map(scene, map, 0, command.map);
  warn_if_changed(scene, map, command.map);
  VerifyOptions options = command.options;
  options.free_space = !is_for_surfaces(map);
  const VerifyResult result = verify(map, scene, light, options);
  if (result.points < command.options.points) {
    write_warning(
        fmt::format("only {} of {} points found in the window", result.points, command.options.points));
  }
  write_result(command.json ? as_json(result) : as_text(result));
  const bool holds = !command.max_error || result.mean_abs_error <= *command.max_error;
  return holds ? kExitOk : kExitDoesNotHold;
}

}  // namespace

void add_verify_command(CLI::App& app, Run& run) {
  auto command = std::make_shared<VerifyCommand>();
  CLI::App& sub = *app.add_subcommand("verify", "Error of a map against shadow rays");
  add_file(sub, "FILE", command->map, "Map");
  add_file(sub, "SCENE", command->scene, "Scene file that it was baked from");
  add_count(sub, "--points", command->options.points, 1, 100'000'000,
            "Points, half on surfaces and half in free space; default 4000");
  add_count(sub, "--samples", command->options.samples, 2, std::uint64_t{1} << 24,
            "Shadow rays a point; default 4096");
  add_real(sub, "--max-error", command->max_error, 0, 1, "Exit 1 when mean_abs_error is above it");
  sub.add_flag("--json", command->json, "Print JSON");
  sub.callback([command, &run] { run = [command] { return run_verify(*command); }; });
}

}  // namespace pdsm
