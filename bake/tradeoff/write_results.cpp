// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/write_results.h"

#include <nlohmann/json.hpp>
#include <span>

#include "pdsm/format/atomic_file.h"
#include "tradeoff/gnuplot.h"
#include "tradeoff/page.h"
#include "tradeoff/pictures.h"
#include "tradeoff/plots.h"
#include "tradeoff/tables.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text) {
  AtomicFile file(path);
  file.write(std::as_bytes(std::span(text)));
  file.commit();
}

std::vector<DrawnPlot> draw_plots(const Sweep& sweep, const std::vector<Standing>& standings,
                                  const fs::path& folder) {
  fs::create_directories(folder);
  std::vector<DrawnPlot> drawn;
  for (const Plot& plot : make_plots(sweep, standings)) {
    drawn.push_back({plot.stem, plot.title, run_gnuplot(plot.script)});
    write_text(folder / (plot.stem + ".gp"), plot.script);
    write_text(folder / (plot.stem + ".svg"), drawn.back().svg);
  }
  return drawn;
}

}  // namespace

void write_results(const Scene& scene, const Sweep& sweep, const SweepOptions& options,
                   const SweepCallbacks& callbacks) {
  const std::vector<Standing> standings = find_standings(sweep);
  write_text(options.folder / "tradeoff.csv", csv_of(sweep, standings));
  write_text(options.folder / "tradeoff.json",
             json_of(scene, sweep, standings, options)
                     .dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
                 "\n");
  const std::vector<DrawnPlot> plots = draw_plots(sweep, standings, options.folder / "plots");
  const DetailPictures details = draw_details(scene, sweep, options.folder / "pictures", callbacks);
  stop_if_cancelled(callbacks);
  write_text(options.folder / "index.html", make_page({scene, options, sweep, standings, plots, details}));
}

}  // namespace pdsm
