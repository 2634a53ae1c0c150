// SPDX-License-Identifier: Apache-2.0
#include "truth_error.h"

#include <cmath>
#include <limits>

#include "truth_job.h"

namespace pdsm {

std::vector<float> truth_error(const CapturedSurfaces& captured,
                               const std::vector<std::vector<float>>& truth) {
  std::vector<float> error(captured.positions.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t light = 0; light < truth.size(); ++light) {
    for (std::size_t pixel = 0; pixel < error.size(); ++pixel) {
      const glm::vec2& look_up = captured.look_ups[light][pixel];
      const float value = truth[light][pixel];
      if (captured.positions[pixel].w == 0.0F || look_up.x < 0 || look_up.y == 0.0F || value < 0) continue;
      const float difference = look_up.x - value;
      if (!(std::abs(difference) <= std::abs(error[pixel]))) error[pixel] = difference;
    }
  }
  return error;
}

std::vector<float> fill_from_coarser(const std::vector<float>& values, const std::vector<float>& known,
                                     int width, int height) {
  std::vector<float> filled(values.size());
  const auto index = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int stride = 1;
      while (known[index(x - x % stride, y - y % stride)] < 0 && stride < kTruthStrides[0]) stride *= 2;
      filled[index(x, y)] = values[index(x - x % stride, y - y % stride)];
    }
  }
  return filled;
}

}  // namespace pdsm
