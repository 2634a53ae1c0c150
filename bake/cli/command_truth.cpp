// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/options.h"
#include "cli/point_lines.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/bake/view_fit.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

struct TruthOptions {
  std::string scene;
  std::optional<std::string> light;
  std::uint32_t samples = 4096;
};

int run_truth(const TruthOptions& options) {
  const Scene scene = read_scene(options.scene);
  const Light& light = choose_light(scene, options.light);
  // The truth knows no window; near alone matters, as it says what belongs to the emitter.
  const ShadowRays rays(scene, light, fit_view(scene, light, 64, 64).view.near_depth);
  answer_point_lines([&](std::span<const glm::dvec3> points, std::string& lines) {
    // One seed for all, so that a point's answer does not depend on its line.
    for (const auto& [red, green, blue] : rays.rgbs(points, options.samples, 0, true)) {
      if (rays.is_coloured())
        fmt::format_to(std::back_inserter(lines), "{:.9g} {:.9g} {:.9g}\n", red, green, blue);
      else
        fmt::format_to(std::back_inserter(lines), "{:.9g}\n", red);
    }
  });
  return kExitOk;
}

}  // namespace

void add_truth_command(CommandLine& line) {
  auto options = std::make_shared<TruthOptions>();
  Options takes = line.add_command(
      "truth",
      "Attenuation by shadow rays: world points \"x y z\" on stdin, one number a line on stdout; three, "
      "red, green and blue, where light or casters are coloured",
      [options] { return run_truth(*options); });
  takes.file("SCENE", options->scene, "Scene file");
  takes.text("--light", "NAME", options->light, "Light; needed when the scene has several");
  takes.count("--samples", options->samples, 1, std::uint64_t{1} << 24, "Shadow rays a point; default 4096");
}

}  // namespace pdsm
