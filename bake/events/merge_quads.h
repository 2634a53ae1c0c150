// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "events/accumulate.h"

namespace pdsm {

/// Gathers events of the next mip level: the mean of four functions has the events of all four. Texel (i, j)
/// of `quads`, width / 2 x height / 2 texels row by row, gets those of texels (2i, 2j) .. (2i + 1, 2j + 1) of
/// `texels`, width x height; the last row or column of an odd size is left out. The keys of each texel are
/// sorted, and stay so. Replaces the contents of `quads`; `room` is to work in.
void merge_quads(const BlockEvents& texels, std::uint32_t width, std::uint32_t height, BlockEvents& quads,
                 std::vector<EventKey>& room);

}  // namespace pdsm
