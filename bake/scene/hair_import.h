// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "pdsm/bake/curves.h"

namespace pdsm {

/// What a hair file holds.
struct ImportedHair {
  Strands strands;
  std::uint64_t left_out = 0;  ///< segments with an end that is not finite or has no width
};

/// Reads a HAIR file (Yuksel, cemyuksel.com/research/hairmodels): a header of 128 bytes, then for each strand
/// how many segments it has, and for each point a place and a thickness, which is a diameter. What it tells
/// of transparency and colour is passed over. Throws FormatFault with the reason.
[[nodiscard]] ImportedHair import_hair(const std::string& bytes);

}  // namespace pdsm
