// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <tuple>

#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// The image of channel 0 whose blocks those of image `n` may be said to be equal to: of the same layer, view
/// and level. None for images of channel 0. The images must be in order.
[[nodiscard]] inline std::optional<std::size_t> red_image(const PenumbraMap& map, std::size_t n) {
  const FunctionImage& image = map.images[n];
  if (image.channel == 0) return std::nullopt;
  const auto key = [](const FunctionImage& i) { return std::tuple(i.layer, i.view, i.channel, i.level); };
  const auto wanted = std::tuple(image.layer, image.view, 0U, image.level);
  const auto found =
      std::lower_bound(map.images.begin(), map.images.end(), wanted,
                       [&](const FunctionImage& candidate, const auto& k) { return key(candidate) < k; });
  if (found == map.images.end() || key(*found) != wanted) return std::nullopt;
  return static_cast<std::size_t>(found - map.images.begin());
}

}  // namespace pdsm
