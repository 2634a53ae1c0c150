// SPDX-License-Identifier: Apache-2.0
#include "ui/ui_state.h"

#include <algorithm>

namespace pdsm {

void FrameTimes::add(double seconds) {
  milliseconds[next] = static_cast<float>(1000 * seconds);
  next = (next + 1) % kCount;
  filled = std::min(filled + 1, kCount);
}

float FrameTimes::median() const {
  if (filled == 0) return 0;
  std::array<float, kCount> sorted = milliseconds;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(filled / 2);
  std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(filled));
  return *middle;
}

}  // namespace pdsm
