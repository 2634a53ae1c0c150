// SPDX-License-Identifier: Apache-2.0
#include "prepared_map.h"

namespace pdsm {

PreparedMap::PreparedMap(const PenumbraMap& map)
    : starts(map.views.size(), std::vector<FunctionStarts>(map.layers.size())),
      coding(map.coding),
      rule(map.layer_rule),
      value_scale(1 / static_cast<double>(map.coding.value_max)) {
  for (std::uint32_t view = 0; view < map.views.size(); ++view) views.push_back(prepare_view(map, view));
  for (const FunctionImage& image : map.images)
    if (image.level == 0) starts[image.view][image.layer] = FunctionStarts(map.coding, image);
}

}  // namespace pdsm
