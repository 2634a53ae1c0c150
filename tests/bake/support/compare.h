// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/baked_functions.h"

namespace pdsm::test {

/// Depths midway between neighbouring vertices of lossless functions, at least `width` from any of them:
/// there the functions are constant, so comparing them at these depths compares all of them.
[[nodiscard]] inline std::vector<double> depths_between(const View& view, const VertexCoding& coding,
                                                        const std::vector<FunctionVertex>& a,
                                                        const std::vector<FunctionVertex>& b, double width) {
  std::vector<double> at{view.near_depth, view.far_depth};
  for (const auto* vertices : {&a, &b}) {
    for (const FunctionVertex& vertex : *vertices) at.push_back(decode_depth(view, coding, vertex.depth));
  }
  std::sort(at.begin(), at.end());
  std::vector<double> between;
  for (std::size_t n = 1; n < at.size(); ++n) {
    if (at[n] - at[n - 1] > 2 * width) between.push_back((at[n - 1] + at[n]) / 2);
  }
  return between;
}

/// Smallest distance in depth that tells events of two lossless bakes apart: each may be off by delta (at
/// least half a code), and a traced depth by 16 float steps at far.
[[nodiscard]] inline double event_width(const BakedFunctions& a, const BakedFunctions& b) {
  return a.report().depth_tolerance + b.report().depth_tolerance + 0x1.0p-20 * a.view().far_depth;
}

/// All encoded blocks of a level are the same, byte for byte.
inline void expect_same_level(const BakedFunctions& a, const BakedFunctions& b, std::size_t level) {
  const auto &x = a.baked().blocks[level], &y = b.baked().blocks[level];
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t n = 0; n < x.size(); ++n) {
    EXPECT_TRUE(x[n].bytes == y[n].bytes) << "level " << level << ", block " << n;
    EXPECT_EQ(x[n].encoding, y[n].encoding) << "level " << level << ", block " << n;
  }
}

/// The same of all levels.
inline void expect_same_bytes(const BakedFunctions& a, const BakedFunctions& b) {
  ASSERT_EQ(a.baked().blocks.size(), b.baked().blocks.size());
  for (std::size_t level = 0; level < a.baked().blocks.size(); ++level) expect_same_level(a, b, level);
}

/// Largest attenuation that any texel holds anywhere.
[[nodiscard]] inline double greatest_value(const BakedFunctions& baked) {
  double greatest = 0;
  for (std::uint32_t j = 0; j < baked.view().height; ++j) {
    for (std::uint32_t i = 0; i < baked.view().width; ++i) {
      for (const FunctionVertex& v : baked.function(i, j)) {
        greatest =
            std::max(greatest, static_cast<double>(std::max(v.begin, v.end)) / baked.map().coding.value_max);
      }
    }
  }
  return greatest;
}

}  // namespace pdsm::test
