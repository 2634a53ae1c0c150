// SPDX-License-Identifier: Apache-2.0
// The experiments of Atty, Holzschuch, Lapierre, Hasenfratz, Hansen, Sillion, "Soft Shadow Maps: Efficient
// Sampling of Light Source Visibility", 2005, section 4.2: error of the shadow that an occluder casts onto a
// plane, as resolution, light and occluder change. Lengths are in units of the light's height above the
// plane.
#include <fmt/format.h>

#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

#include "csv_table.h"
#include "evaluate/window_errors.h"
#include "pdsm/bake/scene_file.h"
#include "steps.h"
#include "timed_bake.h"
#include "tradeoff/gnuplot.h"

namespace pdsm::bench {
namespace {

/// The occluders are 0.2 wide (tests/bench/scenes); the light is half of that where its size is not varied.
constexpr double kLightSide = 0.1;
constexpr std::uint32_t kEdge = 128;
constexpr std::uint32_t kTexels = 4000, kTruthSamples = 1024;

struct Occluder {
  const char* name;
  const char* scene;       ///< file without .scene.json
  double lowest, highest;  ///< of its own height, as the scene file places it
};
constexpr Occluder kOccluders[] = {{"square", "square-on-plane", 0.5, 0.5},
                                   {"bunny", "bunny-on-plane", 0, 0.198},
                                   {"dragon", "dragon-on-plane", 0, 0.141}};

/// One point of a curve.
struct Setup {
  const char* varied;
  double value;
  std::uint32_t edge = kEdge;
  double light = kLightSide;
  double sideways = 0;  ///< how far the occluder is moved along x
  double upwards = 0;   ///< and along y
};

std::vector<Setup> setups_of(const Occluder& occluder) {
  std::vector<Setup> setups;
  for (const std::uint32_t edge : {32U, 48U, 64U, 96U, 128U, 192U, 256U, 384U, 512U})
    setups.push_back({"resolution", static_cast<double>(edge), edge});
  for (const double light : {0.01, 0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.175, 0.2})
    setups.push_back({"light", light, kEdge, light});
  for (const double x : {-0.5, -0.375, -0.25, -0.125, 0.0, 0.125, 0.25, 0.375, 0.5})
    setups.push_back({"lateral", x, kEdge, kLightSide, x});
  // From the plane to the light, short of touching it.
  for (const double share : {0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 0.95}) {
    const double up = share * (1 - occluder.highest + occluder.lowest) - occluder.lowest;
    setups.push_back({"vertical", share, kEdge, kLightSide, 0, up});
  }
  return setups;
}

struct Outcome {
  double error = 0;
  std::uint64_t shadowed = 0, texels = 0;
};

Outcome measure(Scene scene, const Setup& setup, const std::filesystem::path& scratch) {
  glm::dmat4& place = scene.geometry.front().local_to_world;
  place = glm::translate(glm::dmat4(1), glm::dvec3(setup.sideways, setup.upwards, 0)) * place;
  Light light = only_light(scene);
  light.shape = RectLight{setup.light, setup.light};
  BakeOptions options;
  options.width = options.height = setup.edge;
  const PenumbraMap map = decode_blocks(timed_bake(scene, light, options, scratch).baked);
  const auto texels = draw_texels(map.views.front(), kTexels, 0);
  const std::vector<TexelError> errors = measure_texels(map, scene, light, texels, kTruthSamples, 0);
  Outcome outcome{atty_error(errors), 0, errors.size()};
  for (const TexelError& e : errors) outcome.shadowed += e.truth > 0 ? 1 : 0;
  return outcome;
}

/// One curve of each occluder.
void plot(const CsvTable& table, const char* varied, const char* label, const std::filesystem::path& file) {
  constexpr const char* kColours[] = {"#D55E00", "#0072B2", "#009E73"};
  std::string script =
      "set terminal svg size 640,380 dynamic font 'sans-serif,13' background '#ffffff'\n"
      "set border 3 lc rgb '#666666'\nset tics nomirror\nset grid lc rgb '#e4e4e4' lt 1\n"
      "set key outside right top Left reverse samplen 2\nset yrange [0:*]\nset ylabel 'error'\n";
  script += fmt::format("set xlabel '{}'\nset offsets graph 0.03, graph 0.03, graph 0.1, 0\n", label);
  std::string plots;
  std::size_t index = 0;
  for (const Occluder& occluder : kOccluders) {
    script += fmt::format("${} << EOD\n", occluder.name);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      if (table.cell(row, "occluder") != occluder.name || table.cell(row, "varied") != varied) continue;
      script += table.cell(row, "value") + " " + table.cell(row, "error") + "\n";
    }
    script += "EOD\n";
    plots += fmt::format("{} ${} with linespoints pt 7 ps 0.6 lw 2 lc rgb '{}' title '{}'",
                         plots.empty() ? "plot" : ",", occluder.name, kColours[index++], occluder.name);
  }
  std::ofstream stream(file);
  stream << run_gnuplot(script + plots + "\n");
  if (!stream.flush()) throw std::runtime_error(file.string() + ": can't be written");
}

}  // namespace

void measure_soft_shadows(const Folders& folders) {
  CsvTable table{{"occluder", "varied", "value", "error", "shadowed_texels", "texels"}, {}};
  for (const Occluder& occluder : kOccluders) {
    const Scene scene = read_scene(folders.scenes / (std::string(occluder.scene) + ".scene.json"));
    for (const Setup& setup : setups_of(occluder)) {
      const Outcome outcome = measure(scene, setup, folders.scenes);
      table.rows.push_back({occluder.name, setup.varied, fmt::format("{}", setup.value),
                            fmt::format("{:.5f}", outcome.error), std::to_string(outcome.shadowed),
                            std::to_string(outcome.texels)});
    }
    tell(fmt::format("soft shadows: {}", occluder.name));
  }
  write_csv(table, folders.results / "soft-shadow.csv");
  const auto draw = [&](const char* varied, const char* label) {
    plot(table, varied, label, folders.results / fmt::format("soft-shadow-{}.svg", varied));
  };
  draw("resolution", "texels along an edge of the map");
  draw("light", "side of the light");
  draw("lateral", "position of the occluder beside the light");
  draw("vertical", "height of the occluder: 0 on the plane, 1 at the light");
}

}  // namespace pdsm::bench
