// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "evaluate/verify.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "small_sweep.h"
#include "tradeoff/tables.h"

namespace pdsm {
namespace {

using SmallSweep = SweepFolder;

/// Everything but the clock's part.
nlohmann::ordered_json without_seconds(const Measurement& m) {
  nlohmann::ordered_json json = to_json(m);
  json.erase("seconds");
  json.erase("cpu_seconds");
  return json;
}

TEST_F(SmallSweep, MeasuresEverySettingAndFindsEveryFunctionInItsTube) {
  const Scene scene = small_scene();
  const Sweep sweep = run_sweep(scene, scene.lights[0], small_options(), plain_callbacks());
  EXPECT_EQ(sweep.measurements.size(), sweep.plan.setting_count());
  EXPECT_EQ(sweep.earlier, 0U);
  for (const Measurement& m : sweep.measurements) {
    EXPECT_EQ(m.tube.functions, std::uint64_t{m.setting.width} * m.setting.height) << setting_key(m.setting);
    EXPECT_EQ(m.tube.outside, 0U) << setting_key(m.setting);
    EXPECT_EQ(m.error.points, 200U);
    EXPECT_GT(m.error.shadowed_points, 0U);
    EXPECT_GT(m.file_bytes, 0U);
  }
  // A light twice as large has another truth at the same points.
  const auto with_light = [&](double scale) {
    return std::find_if(sweep.measurements.begin(), sweep.measurements.end(),
                        [&](const Measurement& m) { return m.setting.light_scale == scale; });
  };
  EXPECT_GT(with_light(2)->error.shadowed_points, with_light(0.5)->error.shadowed_points);
}

TEST_F(SmallSweep, MeasuresTheDefaultAsVerifyDoes) {
  const Scene scene = small_scene();
  const SweepOptions options = small_options();
  const Sweep sweep = run_sweep(scene, scene.lights[0], options, plain_callbacks());
  const PenumbraMap map = decode_blocks(bake(scene, scene.lights[0], options.options));
  const VerifyResult expected = verify(map, scene, scene.lights[0], options.verify);
  EXPECT_EQ(sweep.measurements.front().error.mean_abs_error, expected.mean_abs_error);
  EXPECT_EQ(sweep.measurements.front().error.shadowed_points, expected.shadowed_points);
  // The map that pictures are drawn with is the one that was measured.
  ASSERT_EQ(sweep.kept.front().name, "default");
  EXPECT_EQ(verify(read_map(sweep.kept.front().file), scene, scene.lights[0], options.verify).mean_abs_error,
            expected.mean_abs_error);
}

TEST_F(SmallSweep, GoesOnWhereItWasStopped) {
  const Scene scene = small_scene();
  SweepCallbacks stopping = plain_callbacks();
  // Asked a few times a bake: stops after some groups.
  stopping.cancelled = [this] {
    const std::string journal = contents("journal.jsonl");
    return std::count(journal.begin(), journal.end(), '\n') > 8;
  };
  try {
    (void)run_sweep(scene, scene.lights[0], small_options(), stopping);
    FAIL() << "was not stopped";
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::interrupted);
  }
  const std::string journal = contents("journal.jsonl");
  const auto measured = static_cast<std::size_t>(std::count(journal.begin(), journal.end(), '\n')) - 1;
  ASSERT_GE(measured, 8U);

  const Sweep rest = run_sweep(scene, scene.lights[0], small_options(), plain_callbacks());
  EXPECT_EQ(rest.earlier, measured);
  EXPECT_TRUE(contents("journal.jsonl").starts_with(journal)) << "what was measured is not measured again";
  SweepOptions anew = small_options();
  anew.folder = path("anew");
  std::filesystem::create_directory(anew.folder);
  const Sweep whole = run_sweep(scene, scene.lights[0], anew, plain_callbacks());
  ASSERT_EQ(rest.measurements.size(), whole.measurements.size());
  for (std::size_t n = 0; n < rest.measurements.size(); ++n)
    EXPECT_EQ(without_seconds(rest.measurements[n]), without_seconds(whole.measurements[n]));
}

TEST_F(SmallSweep, StartsAnewForAnotherScene) {
  Scene scene = small_scene();
  (void)run_sweep(scene, scene.lights[0], small_options(), plain_callbacks());
  EXPECT_GT(run_sweep(scene, scene.lights[0], small_options(), plain_callbacks()).earlier, 0U);
  for (Geometry& geometry : scene.geometry) geometry.casts = false;
  scene.content_hash = 2;
  const Sweep sweep = run_sweep(scene, scene.lights[0], small_options(), plain_callbacks());
  EXPECT_EQ(sweep.earlier, 0U);
  EXPECT_EQ(sweep.measurements.front().error.shadowed_points, 0U);
  const PenumbraMap kept = read_map(sweep.kept.front().file);
  EXPECT_EQ(kept.images.front().blocks.front().first.back(), 0U) << "the map of the first scene was taken";
}

TEST_F(SmallSweep, TablesHaveEverySetting) {
  const Scene scene = small_scene();
  const Sweep sweep = run_sweep(scene, scene.lights[0], small_options(), plain_callbacks());
  const std::vector<Standing> standings = find_standings(sweep);
  const std::string csv = csv_of(sweep, standings);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            1 + sweep.plan.setting_count());
  const auto columns =
      std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
  std::size_t line = csv.find('\n') + 1;
  for (const SettingGroup& group : sweep.plan.groups) {
    for (const TradeoffSetting& s : group.settings) {
      const std::string text = csv.substr(line, csv.find('\n', line) - line);
      line += text.size() + 1;
      EXPECT_EQ(std::count(text.begin(), text.end(), ','), columns) << text;
      EXPECT_NE(
          text.find(fmt::format(",{},{},{},{},{},{},{},", s.samples, s.width, s.height, s.map_scale,
                                s.walk == Walk::exact ? "exact" : "midpoint", s.epsilon, s.light_scale)),
          std::string::npos)
          << text;
    }
  }
  const auto json = json_of(scene, sweep, standings, small_options());
  EXPECT_EQ(json["measurements"].size(), sweep.plan.setting_count());
  EXPECT_EQ(json["measurements"][0]["name"], "default");
}

}  // namespace
}  // namespace pdsm
