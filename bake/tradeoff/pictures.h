// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tradeoff/sweep.h"

namespace pdsm {

/// One picture of the detail.
struct DetailPicture {
  std::string name;                          ///< "truth", "default", ...
  std::optional<Measurement> measurement;    ///< of the map; none for the truth
  std::filesystem::path shadow, difference;  ///< PNG; the truth has no difference
  double mean_difference = 0;                ///< |map - truth| over the detail's pixels
};

/// Pictures of one detail of the scene by several maps, beside the truth.
struct DetailPictures {
  std::filesystem::path overview;  ///< PNG: the whole, with the detail framed
  double scale_top = 1;            ///< |map - truth| that the brightest colour of the differences stands for
  std::vector<DetailPicture> pictures;
};

/// Size of the pictures, pixels.
inline constexpr std::uint32_t kDetailWidth = 320, kDetailHeight = 240;

/// Draws the part of the default view in which the default's map errs most (as a rule its sharpest contact
/// shadow) by all maps that the sweep kept, into `folder`. Throws Error (resource) when it can't be written.
[[nodiscard]] DetailPictures draw_details(const Scene& scene, const Sweep& sweep,
                                          const std::filesystem::path& folder,
                                          const SweepCallbacks& callbacks);

}  // namespace pdsm
