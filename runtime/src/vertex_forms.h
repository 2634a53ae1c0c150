// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "pdsm/format/penumbra_map.h"

/// The three forms of a vertex in textures, whose form is also its number of words. Every coding of a map
/// goes into one of them without loss, and none takes more words than the coding itself:
///   1  depth 16 | begin 8 | end 8, lowest bits first
///   2  depth 32, begin 16 | end 16
///   3  depth 32, begin 32, end 32
namespace pdsm {

[[nodiscard]] inline std::uint32_t vertex_form(const VertexCoding& coding) {
  return coding.words_per_vertex();
}

inline void append_vertex(std::uint32_t form, const FunctionVertex& vertex,
                          std::vector<std::uint32_t>& words) {
  if (form == 1) {
    words.push_back(vertex.depth | vertex.begin << 16 | vertex.end << 24);
  } else if (form == 2) {
    words.insert(words.end(), {vertex.depth, vertex.begin | vertex.end << 16});
  } else {
    words.insert(words.end(), {vertex.depth, vertex.begin, vertex.end});
  }
}

}  // namespace pdsm
