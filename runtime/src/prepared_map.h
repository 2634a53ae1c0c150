// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "function_starts.h"
#include "prepared_view.h"

namespace pdsm {

/// A map, prepared for look-ups. Borrows the map.
struct PreparedMap {
  explicit PreparedMap(const PenumbraMap& map);

  std::vector<PreparedView> views;
  std::vector<std::vector<FunctionStarts>> starts;  ///< by view, then plane
  VertexCoding coding;
  std::uint32_t channels = 1;
  LayerRule rule = LayerRule::maximum;
  double value_scale = 1;  ///< attenuation of one value code
};

/// What a look-up tells of the channels' values, which are real-valued codes: how bright they are together,
/// and each by itself. Of one channel only the first counts.
[[nodiscard]] float grey_of(const PreparedMap& map, const std::array<double, 3>& codes);
[[nodiscard]] std::array<float, 3> rgb_of(const PreparedMap& map, const std::array<double, 3>& codes);

}  // namespace pdsm
