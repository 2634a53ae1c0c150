// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "function_starts.h"
#include "prepared_view.h"

namespace pdsm {

/// A map, prepared for look-ups. Borrows the map.
struct PreparedMap {
  explicit PreparedMap(const PenumbraMap& map);

  std::vector<PreparedView> views;
  std::vector<std::vector<FunctionStarts>> starts;  ///< by view, then layer
  VertexCoding coding;
  LayerRule rule = LayerRule::maximum;
  double value_scale = 1;  ///< attenuation of one value code
};

}  // namespace pdsm
