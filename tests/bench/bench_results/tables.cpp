// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "csv_table.h"
#include "steps.h"
#include "thesis.h"

namespace pdsm::bench {
namespace {

constexpr const char* kBegin = "<!-- tables: begin, written by tests/bench/results -->\n";
constexpr const char* kEnd = "<!-- tables: end -->\n";

double megabytes(const std::string& bytes) {
  return 1e-6 * std::stod(bytes);
}

/// Table 3.1 or 3.2: theirs, then ours on disk and in textures.
std::string size_table(const CsvTable& sizes, const char* scene, const double (&theirs)[5][4]) {
  std::string text =
      "| samples | uncompressed: thesis | ours | ε = 2%: thesis | ours | 5%: thesis | ours | 10%: thesis | "
      "ours |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < thesis::kSamples.size(); ++i) {
    text += fmt::format("| {} |", thesis::kSamples[i]);
    for (std::size_t e = 0; e < thesis::kEpsilons.size(); ++e) {
      const std::size_t row = sizes.find({{"scene", scene},
                                          {"samples", std::to_string(thesis::kSamples[i])},
                                          {"epsilon", fmt::format("{}", thesis::kEpsilons[e])}});
      text += fmt::format(" {} | {:.2f} ({:.2f}) |", theirs[i][e], megabytes(sizes.cell(row, "gpu_bytes")),
                          megabytes(sizes.cell(row, "file_bytes")));
    }
    text += "\n";
  }
  return text;
}

std::size_t time_row(const CsvTable& times, const char* varied, std::uint32_t value, std::uint32_t samples) {
  return times.find(
      {{"varied", varied}, {"value", std::to_string(value)}, {"samples", std::to_string(samples)}});
}

/// Seconds and, behind, what they are of the table's reference.
std::string ratio_cell(double seconds, double reference) {
  return fmt::format("{:.2f} s, {:.3f}", seconds, seconds / reference);
}

/// Table 3.3.
std::string resolution_table(const CsvTable& times) {
  std::string text =
      "| samples | 256²: thesis | ours | 512²: thesis | ours | 1024²: thesis | ours "
      "|\n|---|---|---|---|---|---|---|\n";
  const double ours = times.number(time_row(times, "resolution", 512, 256), "cpu_seconds");
  const double theirs = thesis::kTimes[4][1];
  for (std::size_t i = 0; i < thesis::kSamples.size(); ++i) {
    text += fmt::format("| {} |", thesis::kSamples[i]);
    for (std::size_t r = 0; r < thesis::kResolutions.size(); ++r) {
      const std::size_t row = time_row(times, "resolution", thesis::kResolutions[r], thesis::kSamples[i]);
      const bool below_one = i == 0 && r == 0;
      text += fmt::format(" {}{} s, {:.3f} | {} |", below_one ? "< " : "", thesis::kTimes[i][r],
                          thesis::kTimes[i][r] / theirs, ratio_cell(times.number(row, "cpu_seconds"), ours));
    }
    text += "\n";
  }
  return text;
}

/// Tables 3.4 and 3.5: one row of values, theirs and ours.
template <std::size_t count>
std::string series_table(const CsvTable& times, const char* varied, const char* heading,
                         const std::array<std::uint32_t, count>& values, const double (&theirs)[count],
                         std::size_t reference) {
  std::string text =
      fmt::format("| {} | thesis | ours | rays, M | events, M |\n|---|---|---|---|---|\n", heading);
  const double ours = times.number(time_row(times, varied, values[reference], 256), "cpu_seconds");
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = time_row(times, varied, values[i], 256);
    text += fmt::format("| {} | {} s, {:.3f} | {} | {:.1f} | {:.1f} |\n", values[i], theirs[i],
                        theirs[i] / theirs[reference], ratio_cell(times.number(row, "cpu_seconds"), ours),
                        1e-6 * times.number(row, "rays"), 1e-6 * times.number(row, "events"));
  }
  return text;
}

/// Tables 3.6 and 3.7.
std::string memory_table(const CsvTable& memory) {
  std::string text =
      "| samples | whole: thesis | ours | strips: thesis | ours | time, strips by whole: thesis | rays, the "
      "same: ours |\n"
      "|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < thesis::kSamples.size(); ++i) {
    const std::string samples = std::to_string(thesis::kSamples[i]);
    const std::size_t whole = memory.find({{"samples", samples}, {"tile", "256"}});
    const std::size_t strips = memory.find({{"samples", samples}, {"tile", "128"}});
    const auto above_scene = [&](std::size_t row) {
      return 1e-6 * (memory.number(row, "peak_bytes") - memory.number(row, "scene_bytes"));
    };
    text += fmt::format("| {} | {} MB | {:.0f} MB | {} MB | {:.0f} MB | {:.2f} | {:.2f} |\n", samples,
                        thesis::kMemory[i][0], above_scene(whole), thesis::kMemory[i][1], above_scene(strips),
                        thesis::kMemoryTimes[i][1] / thesis::kMemoryTimes[i][0],
                        memory.number(strips, "rays") / memory.number(whole, "rays"));
  }
  return text;
}

/// Table 3.8.
std::string thread_table(const CsvTable& threads) {
  std::string text =
      "| samples | one: thesis | ours | two: thesis | ours | gain: thesis | ours "
      "|\n|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < thesis::kSamples.size(); ++i) {
    const std::string samples = std::to_string(thesis::kSamples[i]);
    const double one = threads.number(threads.find({{"samples", samples}, {"threads", "1"}}), "seconds");
    const double two = threads.number(threads.find({{"samples", samples}, {"threads", "2"}}), "seconds");
    const double(&theirs)[2] = thesis::kThreadTimes[i];
    text += fmt::format("| {} | {} s | {:.2f} s | {} s | {:.2f} s | {:.2f} | {:.2f} |\n", samples, theirs[0],
                        one, theirs[1], two, theirs[0] / theirs[1], one / two);
  }
  return text;
}

/// Growth, and what is counted: ours alone.
std::string plain_table(const CsvTable& csv) {
  std::string text = "|", rule = "|";
  for (const std::string& column : csv.columns) {
    text += " " + column + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (std::size_t row = 0; row < csv.rows.size(); ++row) {
    text += "|";
    for (std::size_t c = 0; c < csv.columns.size(); ++c)
      text += " " + (c < csv.rows[row].size() ? csv.rows[row][c] : "") + " |";
    text += "\n";
  }
  return text;
}

/// Table 4.1: what bench_look_up and bench_shadow_pass printed.
std::string look_up_tables(const Folders& folders) {
  std::string text =
      "| thesis, frames a second | software, unfiltered | bilinear | GPU, unfiltered | bilinear "
      "|\n|---|---|---|---|---|\n";
  constexpr const char* kScenes[] = {"Sphere", "Plant"};
  for (std::size_t i = 0; i < 2; ++i) {
    const double(&f)[4] = thesis::kFrames[i];
    text += fmt::format("| {} | {} | {} | {} | {} |\n", kScenes[i], f[0], f[1], f[2], f[3]);
  }
  text +=
      "\n| ours, one core, million look-ups a second | one at a time | many at once | ratio "
      "|\n|---|---|---|---|\n";
  const CsvTable look_ups = read_csv(folders.results / "look-up.csv");
  for (std::size_t row = 0; row < look_ups.rows.size(); ++row)
    text += fmt::format("| {} | {} | {} | {} |\n", look_ups.cell(row, "points"),
                        look_ups.cell(row, "one_at_a_time"), look_ups.cell(row, "many_at_once"),
                        look_ups.cell(row, "ratio"));
  text +=
      "\n| ours, shadow pass of 1024 x 1024 pixels | milliseconds | by percentage-closer soft shadows | "
      "texture, MB |\n|---|---|---|---|\n";
  const CsvTable passes = read_csv(folders.results / "shadow-pass.csv");
  for (std::size_t row = 0; row < passes.rows.size(); ++row) {
    text += fmt::format("| {} | {} | {} | {:.2f} |\n", passes.cell(row, "technique"),
                        passes.cell(row, "milliseconds"), passes.cell(row, "over_pcss"),
                        megabytes(passes.cell(row, "texture_bytes")));
  }
  return text;
}

/// The curves of one parameter as a table.
std::string curve_table(const CsvTable& curves, const char* varied, const char* heading) {
  std::string text = fmt::format("| {} | square | bunny | dragon |\n|---|---|---|---|\n", heading);
  for (std::size_t row = 0; row < curves.rows.size(); ++row) {
    if (curves.cell(row, "occluder") != "square" || curves.cell(row, "varied") != varied) continue;
    const std::string& value = curves.cell(row, "value");
    text += "| " + value + " |";
    for (const char* occluder : {"square", "bunny", "dragon"}) {
      const std::size_t of = curves.find({{"occluder", occluder}, {"varied", varied}, {"value", value}});
      text += fmt::format(" {:.4f} |", curves.number(of, "error"));
    }
    text += "\n";
  }
  return text;
}

std::string section(const char* heading, const char* words, const std::string& table) {
  return fmt::format("### {}\n{}\n\n{}\n", heading, words, table);
}

std::string curve_section(const CsvTable& curves, const char* varied, const char* heading,
                          const char* words) {
  return fmt::format("### {}\n{}\n\n![{}](soft-shadow-{}.svg)\n\n{}\n", heading, words, heading, varied,
                     curve_table(curves, varied, varied));
}

}  // namespace

std::string make_tables(const Folders& folders) {
  const CsvTable sizes = read_csv(folders.results / "size.csv"),
                 times = read_csv(folders.results / "time.csv");
  const CsvTable curves = read_csv(folders.results / "soft-shadow.csv");
  std::string text;
  text += section("Table 3.1: size, dragon, 512 x 512",
                  "MB; ours as functions in textures, in brackets as a file.",
                  size_table(sizes, "dragon", thesis::kDragonSizes));
  text += section("Table 3.2: size, a scene of many edges, 512 x 512",
                  "Theirs is Nature, ours the level: not one scene, only the trends compare.",
                  size_table(sizes, "level", thesis::kNatureSizes));
  text += section(
      "Table 3.3: time by resolution and samples",
      "Dragon, sample maps 512 x 512, ε = 0.02. Ours in processor seconds of all threads; behind each time, "
      "what it is of 256 samples at 512 x 512.",
      resolution_table(times));
  text += section("Table 3.4: time by resolution of the sample maps",
                  "Dragon, 512 x 512, 256 samples; ratios to 512.",
                  series_table(times, "map", "sample maps", thesis::kMapResolutions, thesis::kMapTimes, 2));
  text += section("Table 3.5: time by light size", "Dragon, 512 x 512, 256 samples; ratios to 5.",
                  series_table(times, "light", "light", thesis::kLightSizes, thesis::kLightTimes, 4));
  text += section("Tables 3.6 and 3.7: memory and strips",
                  "Dragon, 256 x 256, all at once and in parts: theirs of 128 rows, ours tiles of 128 x 128. "
                  "Ours is what "
                  "the process had at its peak above scene and BVH; building the BVH takes 29 MB of that for "
                  "a while, which hides "
                  "whatever is less.",
                  memory_table(read_csv(folders.results / "memory.csv")));
  text += section("Table 3.8: threads", "Dragon, 512 x 512, wall-clock, the least of three runs.",
                  thread_table(read_csv(folders.results / "threads.csv")));
  text += section(
      "Growth",
      "Bake alone, without BVH, 256 samples and 512 x 512 where not varied, sample maps as fine as the map; "
      "a waved "
      "torus in the dragon's place for triangles. Power: the time grows with that power of the value.",
      plain_table(read_csv(folders.results / "growth.csv")));
  text += section("Counts",
                  "What the defaults make of five lights, and may not exceed by more than a hundredth "
                  "(tests/bench/limits.csv).",
                  plain_table(read_csv(folders.results / "counts.csv")));
  text += section("Table 4.1: look-up", "What of this compares is said above.", look_up_tables(folders));
  text += curve_section(curves, "resolution", "Atty et al., figure 17: resolution", "");
  text += curve_section(curves, "light", "Figure 18: size of the light", "");
  text += curve_section(curves, "lateral", "Figure 19: the occluder moves sideways", "");
  text += curve_section(curves, "vertical", "Figure 20: the occluder rises to the light", "");
  return text;
}

void replace_tables(const std::filesystem::path& document, const std::string& tables) {
  std::ifstream in(document, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  const std::size_t begin = text.find(kBegin), end = text.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw std::runtime_error(document.string() + ": has no marks for tables");
  const std::size_t first = begin + std::char_traits<char>::length(kBegin);
  text.replace(first, end - first, tables);
  std::ofstream out(document, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(document.string() + ": can't be written");
}

}  // namespace pdsm::bench
