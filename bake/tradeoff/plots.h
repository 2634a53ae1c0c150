// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tradeoff/sweep.h"
#include "tradeoff/tables.h"

/// Plots of a sweep as scripts for gnuplot, their data within. All functions are pure.
namespace pdsm {

/// One plot of the page.
struct Plot {
  std::string stem;   ///< of its files: stem.gp, stem.svg
  std::string title;  ///< what it shows, for those who can't see it
  std::string script;
};

/// Error against seconds, against bytes of the file, against bytes on the GPU, and what each factor alone
/// changes.
[[nodiscard]] std::vector<Plot> make_plots(const Sweep& sweep, const std::vector<Standing>& standings);

}  // namespace pdsm
