// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "cli/bake_options.h"
#include "cli/bake_record.h"
#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/progress_line.h"
#include "cli/streams.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/format/error.h"
#include "scene/scene_channels.h"
#include "tradeoff/gnuplot.h"
#include "tradeoff/tables.h"
#include "tradeoff/write_results.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

struct TradeoffCommand {
  std::string scene, output;
  std::optional<std::string> light;
  SweepOptions options;
  bool quiet = false;
};

/// Makes the folder, in one that is there, and tries what will be written.
void prepare_folder(const fs::path& folder, const std::vector<fs::path>& inputs) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    if (fs::exists(folder, error)) throw Error(Failure::usage, "--output", "must be a folder");
    if (!fs::create_directory(folder, error))
      throw Error(Failure::resource, folder.string(), error.message());
  }
  for (const char* name : kResultFiles) check_output(folder / name, inputs);
}

/// The centre as a bake of the light would have it, and the presets.
void set_options(SweepOptions& options, const Light& light) {
  BakeCommand bake;
  bake.options = options.options;
  const auto preset = [&bake, &light](const char* name, Quality quality) {
    bake.quality = quality;
    return NamedSetting{name, setting_of(options_for(bake, light))};
  };
  options.options = options_for(bake, light);
  options.presets = {preset("draft", Quality::draft), preset("game", Quality::game),
                     preset("final", Quality::final)};
}

SweepCallbacks callbacks_for(ProgressLine& line) {
  SweepCallbacks callbacks;
  callbacks.progress = [&line](const SweepProgress& p) { line.show({p.step, p.done, 0}); };
  callbacks.cancelled = [] { return PolledInterrupts::interrupted(); };
  callbacks.metadata = [](const Light& light, const BakeOptions& options, const BakedMap& baked) {
    return bake_metadata(light, options, baked);
  };
  return callbacks;
}

std::string better_text(const char* what, const Measurement& mine, const Measurement& best) {
  if (&mine == &best) return fmt::format("{:<22}nothing measured is better\n", what);
  return fmt::format("{:<22}{:.4f} in {:.2f} processor seconds, {} bytes: {}\n", what,
                     best.error.mean_abs_error, best.cpu_seconds, best.file_bytes,
                     setting_text(best.setting));
}

std::string summary(const Sweep& sweep, const fs::path& folder) {
  const TubeCheck tube = total_tube(sweep);
  std::string text = fmt::format(
      "bakes                 {} ({} from an earlier run)\n"
      "functions checked     {}, {} outside their tube, least margin {:.3g}\n",
      sweep.measurements.size(), sweep.earlier, tube.functions, tube.outside, tube.worst_margin);
  for (const NamedStanding& standing : named_standings(sweep)) {
    const Measurement& m = *standing.measured;
    text += fmt::format("{:<22}{:.4f} in {:.2f} processor seconds, {} bytes: {}\n", standing.name,
                        m.error.mean_abs_error, m.cpu_seconds, m.file_bytes, setting_text(m.setting));
    text += better_text("  for no more time", m, *standing.best_in_time);
    text += better_text("  for no more bytes", m, *standing.best_in_file);
  }
  return text + fmt::format("page                  {}\n", (folder / "index.html").string());
}

int run_tradeoff(TradeoffCommand command) {
  require_gnuplot();
  const fs::path folder = command.output;
  prepare_folder(folder, scene_inputs(command.scene));
  const Scene scene = read_scene(command.scene);
  const Light& light = choose_light(scene, command.light);
  if (view_count(light) > 1)
    throw Error(Failure::usage, "--light", "lights of several faces can't be swept: " + light.name);
  if (may_be_coloured(scene, light))
    throw Error(Failure::usage, "--light", "coloured shadows can't be swept: " + light.name);
  command.options.folder = folder;
  set_options(command.options, light);

  ProgressLine line({"tradeoff", ""}, progress_style(command.quiet));
  const PolledInterrupts interrupts;
  const SweepCallbacks callbacks = callbacks_for(line);
  const Sweep sweep = run_sweep(scene, light, command.options, callbacks);
  write_results(scene, sweep, command.options, callbacks);
  write_result(summary(sweep, folder));
  return total_tube(sweep).outside == 0 ? kExitOk : kExitDoesNotHold;
}

}  // namespace

void add_tradeoff_command(CommandLine& line) {
  auto command = std::make_shared<TradeoffCommand>();
  SweepOptions& options = command->options;
  Options takes = line.add_command("tradeoff", "Error, time and size of a light's map over its settings",
                                   [command] { return run_tradeoff(*command); });
  takes.file("SCENE", command->scene, "Scene file");
  takes.text("-o,--output", "DIR", command->output, "Folder for tables, plots and one HTML page").required();
  takes.text("--light", "NAME", command->light, "Needed when the scene has several");
  takes.choice("--effort", options.effort,
               {{"quick", Effort::quick}, {"normal", Effort::normal}, {"full", Effort::full}},
               "How many settings; default normal");
  takes.count("--points", options.verify.points, 1, 100'000'000,
              "Points, half on surfaces and half in free space; default 4000");
  takes.count("--truth-samples", options.verify.samples, 2, std::uint64_t{1} << 24,
              "Shadow rays a point; default 4096");
  takes.memory("--memory", options.options.memory,
               "What a bake may take beyond scene and BVH: 256M, 4G; default 4G");
  takes.count("--threads", options.options.threads, 0, 1024, "Default 0: all processors");
  takes.flag("--quiet", command->quiet, "Nothing but errors on stderr");
}

}  // namespace pdsm
