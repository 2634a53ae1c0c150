// SPDX-License-Identifier: Apache-2.0
#include "cli/parse_camera.h"

#include <algorithm>
#include <vector>

#include "cli/option_values.h"

namespace pdsm {

Camera parse_camera(const std::string& text) {
  constexpr double kFar = 1e9, kNarrowest = 0.01, kWidest = 170;
  const std::string option = "--camera";
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(parse_real(option, text.substr(begin, end - begin), -kFar, kFar));
    begin = end + 1;
  }
  if (numbers.size() != 7) refuse_value(option, "eye x,y,z, target x,y,z and fov: seven numbers", text);
  const Camera camera{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}, numbers[6]};
  if (!(camera.fov >= kNarrowest && camera.fov <= kWidest))
    refuse_value(option, "of a fov 0.01 .. 170", text);
  if (camera.eye == camera.target) refuse_value(option, "of two points", text);
  return camera;
}

}  // namespace pdsm
