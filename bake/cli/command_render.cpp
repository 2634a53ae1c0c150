// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/options.h"
#include "cli/parse_camera.h"
#include "cli/scene_change.h"
#include "cli/streams.h"
#include "evaluate/render.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/bake/view_fit.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

struct RenderCommand {
  std::vector<std::string> files;  ///< maps, then the scene
  std::string output;
  RenderOptions options;
  bool truth = false, difference = false;
};

/// Lights with maps, or for the truth alone all lights.
std::vector<PictureLight> picture_lights(const Scene& scene, const std::vector<PenumbraMap>& maps,
                                         const RenderCommand& command) {
  std::vector<PictureLight> lights;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Light& light = light_of_map(scene, maps[i], i, command.files[i]);
    const auto same = [&light](const PictureLight& other) { return other.light == &light; };
    if (std::any_of(lights.begin(), lights.end(), same)) {
      throw Error(Failure::usage, command.files[i], "is a second map of light '" + light.name + "'");
    }
    warn_if_changed(scene, light, maps[i], command.files[i]);
    lights.push_back({&light, &maps[i], maps[i].views.front().near_depth});
  }
  if (!maps.empty()) return lights;
  for (const Light& light : scene.lights) {
    lights.push_back({&light, nullptr, fit_view(scene, light, 64, 64).view.near_depth});
  }
  return lights;
}

void write_picture(const Picture& picture, const RenderCommand& command) {
  const bool exr = image_format(command.output, "--output") == ImageFormat::exr;
  const RgbImage& linear = picture.linear;
  if (!command.difference) {
    if (exr) return write_exr(linear.width, linear.height, split_planes(linear), command.output);
    return write_png(picture.display, command.output);
  }
  if (exr) {
    write_exr(linear.width, linear.height, {{"Y", picture.difference}}, command.output);
  } else {
    write_png(draw_difference(picture), command.output);
  }
  const DifferenceSummary summary = summarise_difference(picture.difference);
  write_result(fmt::format("pixels {}\nmean {:.6f}\nrms {:.6f}\nmax {:.6f}\n", summary.pixels,
                           summary.mean_abs, summary.rms, summary.max));
}

void check_usage(const RenderCommand& command) {
  if (command.truth && command.difference) throw Error(Failure::usage, "--truth", "excludes --difference");
  if (command.files.size() < 2 && !command.truth) {
    throw Error(Failure::usage, "FILE", "a map and then the scene are needed");
  }
  (void)image_format(command.output, "--output");
}

int run_render(RenderCommand command) {
  check_usage(command);
  const std::string scene_file = command.files.back();
  std::vector<std::filesystem::path> inputs = scene_inputs(scene_file);
  inputs.insert(inputs.end(), command.files.begin(), command.files.end() - 1);
  check_output(command.output, inputs);

  std::vector<PenumbraMap> maps;
  for (std::size_t i = 0; i + 1 < command.files.size(); ++i) maps.push_back(read_map(command.files[i]));
  const Scene scene = read_scene(scene_file);
  const std::vector<PictureLight> lights = picture_lights(scene, maps, command);
  if (lights.size() < scene.lights.size()) {
    write_warning(fmt::format("{} of {} lights have no map and stay dark",
                              scene.lights.size() - lights.size(), scene.lights.size()));
  }
  if (command.truth) command.options.source = ShadowSource::truth;
  if (command.difference) command.options.source = ShadowSource::difference;
  write_picture(render(scene, lights, command.options), command);
  return kExitOk;
}

}  // namespace

void add_render_command(CommandLine& line) {
  auto command = std::make_shared<RenderCommand>();
  RenderOptions& options = command->options;
  Options takes = line.add_command("render", "A picture of a scene with its maps' shadows",
                                   [command] { return run_render(*command); });
  takes.texts("FILE", "", command->files, "Maps, then the scene file; the scene alone with --truth")
      .required();
  takes.text("-o,--output", "IMAGE.png|.exr", command->output, "Picture to write; EXR: linear light")
      .required();
  takes.value(
      "--camera", "EX,EY,EZ,TX,TY,TZ,FOV",
      [&options](const std::string& text) { options.camera = parse_camera(text); },
      "Default: a three-quarter view of the casters. fov in degrees, of the shorter side");
  takes.value(
      "--size", "WxH",
      [&options](const std::string& text) {
        const auto size = parse_size("--size", text, kMostTexels);
        options.width = size[0];
        options.height = size[1];
      },
      "Pixels; default 960x720");
  takes.count("--supersample", options.supersample, 1, 8, "Rays a pixel along each axis; default 2");
  takes.flag("--truth", command->truth, "Shadows by shadow rays instead of the maps");
  takes.flag("--difference", command->difference, "Heat map of |map - truth|; EXR: map - truth, signed");
  takes.count("--truth-samples", options.truth_samples, 1, kMostSamples,
              "Shadow rays a viewing ray; default 256");
}

}  // namespace pdsm
