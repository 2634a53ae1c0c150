// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

/// The functions of one attenuation function that pdsm.glsl has, compiled for the CPU in double: search,
/// piece, filter weights. What differs is how a vertex is fetched, which is the base class here:
///   std::uint32_t depth(n), begin(n), end(n)   codes of vertex n
namespace pdsm::shader {

using std::ceil, std::log2, std::max, std::min;
using uint = std::uint32_t;

template <typename Vertices>
struct Functions : Vertices {
#define PDSM_REAL double
#define PDSM_FUNCTIONS_ONLY
#include "pdsm.glsl"
#undef PDSM_GLSL
#undef PDSM_FUNCTIONS_ONLY
#undef PDSM_REAL

  // The head of a vertex is its number: fetching a field twice costs nothing here.
  static uint pdsm_head(uint, const PdsmFunction& f, uint n) {
    return f.first + n;
  }
  uint pdsm_depth(const PdsmFunction&, uint head) const {
    return this->depth(head);
  }
  uint pdsm_begin(uint, const PdsmFunction&, uint, uint head) const {
    return this->begin(head);
  }
  uint pdsm_end(uint, const PdsmFunction&, uint, uint head) const {
    return this->end(head);
  }
};

/// For what needs no vertices.
struct NoVertices {
  static uint depth(uint) { return 0; }
  static uint begin(uint) { return 0; }
  static uint end(uint) { return 0; }
};
using PlainFunctions = Functions<NoVertices>;

}  // namespace pdsm::shader
