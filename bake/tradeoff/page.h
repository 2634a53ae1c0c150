// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tradeoff/pictures.h"
#include "tradeoff/sweep.h"
#include "tradeoff/tables.h"

namespace pdsm {

/// A plot as SVG, for the page.
struct DrawnPlot {
  std::string stem, title, svg;
};

/// What the page shows.
struct PageContents {
  const Scene& scene;
  const SweepOptions& options;
  const Sweep& sweep;
  const std::vector<Standing>& standings;
  const std::vector<DrawnPlot>& plots;  ///< in the order of make_plots()
  const DetailPictures& details;
};

/// The sweep as one HTML document that needs nothing else: plots and pictures are in it, no scripts.
/// Throws Error (resource) when a picture can't be read back.
[[nodiscard]] std::string make_page(const PageContents& contents);

}  // namespace pdsm
