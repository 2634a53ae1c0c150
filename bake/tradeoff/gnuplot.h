// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pdsm {

/// Throws Error (resource) "gnuplot: reason" unless a gnuplot that draws SVG is in PATH.
void require_gnuplot();

/// What gnuplot prints when it runs `script`: with the terminal svg and no output set, a picture. Throws
/// Error (resource) "gnuplot: its first line of complaint".
[[nodiscard]] std::string run_gnuplot(const std::string& script);

}  // namespace pdsm
