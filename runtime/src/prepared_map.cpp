// SPDX-License-Identifier: Apache-2.0
#include "prepared_map.h"

#include "planes.h"
#include "shader_functions.h"

namespace pdsm {

PreparedMap::PreparedMap(const PenumbraMap& map)
    : starts(map.views.size(), std::vector<FunctionStarts>(plane_count(map))),
      coding(map.coding),
      channels(map.channels),
      rule(map.layer_rule),
      value_scale(1 / static_cast<double>(map.coding.value_max)) {
  for (std::uint32_t view = 0; view < map.views.size(); ++view) views.push_back(prepare_view(map, view));
  for (const FunctionImage& image : map.images)
    if (image.level == 0) starts[image.view][plane_of(map, image)] = FunctionStarts(map.coding, image);
}

float grey_of(const PreparedMap& map, const std::array<double, 3>& codes) {
  const double code =
      map.channels == 1 ? codes[0] : shader::PlainFunctions().pdsm_grey(codes[0], codes[1], codes[2]);
  return static_cast<float>(code * map.value_scale);
}

std::array<float, 3> rgb_of(const PreparedMap& map, const std::array<double, 3>& codes) {
  std::array<float, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] = static_cast<float>(codes[map.channels == 1 ? 0 : c] * map.value_scale);
  return rgb;
}

}  // namespace pdsm
