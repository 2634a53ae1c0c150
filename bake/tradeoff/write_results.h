// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tradeoff/sweep.h"

namespace pdsm {

/// Names that write_results() gives files in a sweep's folder, besides those in plots/ and pictures/.
inline constexpr const char* kResultFiles[] = {"tradeoff.csv", "tradeoff.json", "index.html"};

/// Draws plots and pictures and writes all results of a sweep into its folder, index.html last. Throws Error
/// (resource) when a file can't be written or gnuplot fails.
void write_results(const Scene& scene, const Sweep& sweep, const SweepOptions& options,
                   const SweepCallbacks& callbacks);

}  // namespace pdsm
