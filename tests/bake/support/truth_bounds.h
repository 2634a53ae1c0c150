// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>

#include "support/baked_functions.h"

/// How bakes are made that are held to closed forms, and how near they must come.
namespace pdsm::test {

struct Method {
  Walk walk;
  PointSet points;
  double epsilon;
};

/// Of bakes whose maps have `map_scale` times as many texels along each axis.
[[nodiscard]] inline BakeOptions method_options(const Method& method, std::uint32_t width,
                                                std::uint32_t height, std::uint32_t samples,
                                                std::uint32_t map_scale) {
  BakeOptions options = small_options(width, height, samples);
  options.map_width = width * map_scale;
  options.map_height = height * map_scale;
  options.walk = method.walk;
  options.points = method.points;
  options.epsilon = method.epsilon;
  return options;
}

/// V at depth z when all edges are moved outwards by `shift` (inwards: negative).
using ShiftedTruth = std::function<double(double z, double shift)>;

/// Bounds of a baked value, without sampling and epsilon. V is monotone in z and in the shift.
struct Bounds {
  double low, high;
};

[[nodiscard]] inline Bounds bound(const ShiftedTruth& truth, double z, double delta, double shift) {
  Bounds b{1, 0};
  for (const double depth : {z - delta, z + delta}) {
    b.low = std::min(b.low, truth(depth, -shift));
    b.high = std::max(b.high, truth(depth, shift));
  }
  return b;
}

}  // namespace pdsm::test
