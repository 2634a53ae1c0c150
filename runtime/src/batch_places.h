// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "pdsm/runtime/look_up.h"
#include "prepared_view.h"

namespace pdsm {

/// Points that go through the steps of a batched look-up together: enough that fetches overlap, few enough
/// that what was fetched for them is still in the first cache when it is read.
inline constexpr std::size_t kBatchSize = 64;

/// The depth of points that a view does not hold.
inline constexpr double kNotHeld = -std::numeric_limits<double>::infinity();

/// Where the points of a batch meet a view, as far as a filter wants to know.
struct PlaceBatch {
  /// Metres, finite; or kNotHeld.
  std::array<double, kBatchSize> z;
  /// The texel that holds the point; for bilinear, the lower left one of the four.
  std::array<std::uint32_t, kBatchSize> x_low, y_low;
  /// Bilinear: weights of the texels to the right and above.
  std::array<double, kBatchSize> x_share, y_share;
};

/// The places of `count` <= kBatchSize world points: what place_in_world, pdsm_between and pdsm_holding say,
/// bit for bit. Of points that are not held only z is worth something.
void place_batch(const PreparedView& prepared, const std::array<double, 3>* points, std::size_t count,
                 Filter filter, PlaceBatch& places);

}  // namespace pdsm
