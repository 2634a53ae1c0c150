// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "csv_table.h"
#include "steps.h"
#include "tradeoff/front.h"

namespace pdsm::bench {
namespace {

/// The rows of one sweep, with the light at its own size.
struct SweepRows {
  CsvTable table;
  std::vector<std::size_t> rows;

  [[nodiscard]] std::vector<Choice> choices(const char* cost) const {
    std::vector<Choice> choices;
    for (const std::size_t row : rows)
      choices.push_back({table.number(row, cost), table.number(row, "mean_abs_error")});
    return choices;
  }
};

SweepRows read_sweep(const std::filesystem::path& path) {
  SweepRows sweep{read_csv(path), {}};
  for (std::size_t row = 0; row < sweep.table.rows.size(); ++row) {
    if (sweep.table.number(row, "light_scale") == 1) sweep.rows.push_back(row);
  }
  return sweep;
}

std::string setting_cell(const CsvTable& table, std::size_t row) {
  const auto cell = [&](const char* column) { return table.cell(row, column); };
  return fmt::format("{} samples, {} x {}, ε {}{}{}", cell("samples"), cell("width"), cell("height"),
                     cell("epsilon"), cell("map_scale") == "1" ? "" : ", sample maps x " + cell("map_scale"),
                     cell("walk") == "exact" ? "" : ", midpoint walk");
}

std::string line(const char* what, const CsvTable& table, std::size_t row) {
  return fmt::format("| {} | {} | {:.4f} | {:.2f} | {:.0f} | {:.3f} |\n", what, setting_cell(table, row),
                     table.number(row, "mean_abs_error"), table.number(row, "cpu_seconds"),
                     1e-6 * table.number(row, "rays"), 1e-6 * table.number(row, "file_bytes"));
}

/// The default, and what errs least for no more of each cost; how far the default is from it.
std::string front_table(const SweepRows& sweep) {
  std::string text =
      "| | setting | mean abs error | processor s | rays, M | file, MB |\n|---|---|---|---|---|---|\n";
  // The default is the first that a sweep measures.
  const std::size_t first = sweep.rows.front();
  text += line("default", sweep.table, first);
  struct Cost {
    const char *column, *words;
  };
  for (const Cost& cost : {Cost{"cpu_seconds", "least error for no more time"},
                           Cost{"rays", "for no more rays"}, Cost{"file_bytes", "for a file no larger"}}) {
    const std::size_t best = best_within(sweep.choices(cost.column), sweep.table.number(first, cost.column));
    text += line(cost.words, sweep.table, sweep.rows[best]);
  }
  return text;
}

std::string tube_line(const SweepRows& sweep) {
  double functions = 0, outside = 0;
  for (std::size_t row = 0; row < sweep.table.rows.size(); ++row) {
    functions += sweep.table.number(row, "tube_functions");
    outside += sweep.table.number(row, "tube_outside");
  }
  return fmt::format("{} bakes; {:.0f} of {:.0f} functions left their tube.", sweep.table.rows.size(),
                     outside, functions);
}

}  // namespace

std::string make_front_tables(const Folders& folders) {
  std::string text = "## Fronts\n\n";
  for (const char* scene : {"dragon", "plate", "courtyard"}) {
    const SweepRows sweep = read_sweep(folders.results / fmt::format("front-{}.csv", scene));
    text += fmt::format(
        "### {}\n{}\n\n{}\n![{} against time](front-{}-time.svg)\n![{} against bytes](front-{}-file.svg)\n\n",
        scene, tube_line(sweep), front_table(sweep), scene, scene, scene, scene);
  }
  return text;
}

}  // namespace pdsm::bench
