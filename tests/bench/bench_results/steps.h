// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "pdsm/bake/scene.h"

/// The parts of the evaluation. Each reads scenes from one folder and writes tables into another.
namespace pdsm::bench {

struct Folders {
  std::filesystem::path scenes;   ///< *.scene.json, with the data beside them, and *.csv of other programs
  std::filesystem::path results;  ///< *.csv, *.svg
  std::filesystem::path pdsm;     ///< the command line, for what has to be a process of its own
};

/// Tables 3.1 and 3.2 of the thesis: sizes by samples and epsilon, of two scenes. size.csv
void measure_sizes(const Folders& folders);
/// Tables 3.3, 3.4, 3.5: time by resolution, map resolution, light size. time.csv
void measure_times(const Folders& folders);
/// Tables 3.6, 3.7: memory and time of a map as a whole and in strips. memory.csv
void measure_memory(const Folders& folders);
/// Table 3.8: time by threads. threads.csv
void measure_threads(const Folders& folders);
/// How time grows with samples, texels (maps with them) and triangles; power: time over value, step by step.
/// growth.csv
void measure_growth(const Folders& folders);

/// A count is above its limit.
class LimitExceeded : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
/// What the defaults make of some scenes that is not time: rays, events, pieces, bytes. counts.csv
/// Throws LimitExceeded when one is above its limit in tests/bench/limits.csv.
void measure_counts(const Folders& folders);
/// The curves of Atty et al. 2005, figures 17 to 20. soft-shadow.csv and plots
void measure_soft_shadows(const Folders& folders);

/// All tables as Markdown, ours beside theirs, from the csv files of all steps.
[[nodiscard]] std::string make_tables(const Folders& folders);

/// Where the defaults stand among other settings, from front-*.csv, as Markdown.
[[nodiscard]] std::string make_front_tables(const Folders& folders);

/// Puts `tables` into a document between its two marks, in place of what is there. Throws
/// std::runtime_error when it has no marks.
void replace_tables(const std::filesystem::path& document, const std::string& tables);

/// A line on stderr.
void tell(const std::string& line);

/// The only light of an evaluation scene.
[[nodiscard]] const Light& only_light(const Scene& scene);

}  // namespace pdsm::bench
