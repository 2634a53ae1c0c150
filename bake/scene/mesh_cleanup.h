// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// Triangles of one file that were left out, by reason.
struct LeftOut {
  std::uint64_t bad_index = 0;   ///< a corner that the file does not have
  std::uint64_t not_finite = 0;  ///< NaN, infinite, or too large to be squared in float
  std::uint64_t no_area = 0;     ///< corners that coincide or lie on one line

  [[nodiscard]] std::uint64_t total() const { return bad_index + not_finite + no_area; }
};

/// "12 triangles with NaN or infinite coordinates, 3 without area left out"; empty when there are none.
[[nodiscard]] std::string describe(const LeftOut& left_out);

/// Leaves out triangles that cannot be traced and counts them, joins equal positions, drops unused ones,
/// and sets `closed`. Triangles keep their order and winding.
[[nodiscard]] Mesh clean_mesh(const Mesh& raw, LeftOut& left_out);

/// `mesh` with equal positions (0 equals -0) joined, those of a mesh with a mask where their places in it are
/// equal too, and unused ones dropped. All indices must be in range and all used positions and places finite.
[[nodiscard]] Mesh weld(const Mesh& mesh);

}  // namespace pdsm
