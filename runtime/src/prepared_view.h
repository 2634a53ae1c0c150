// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "code_depth.h"
#include "pdsm/format/penumbra_map.h"
#include "pdsm/runtime/look_up.h"

/// A map's views, prepared for look-ups: constants instead of divisions, pointers instead of searches.
namespace pdsm {

/// A block's arrays, borrowed.
struct BlockPointers {
  const std::uint32_t* first = nullptr;
  const std::uint32_t* words = nullptr;
  const std::uint32_t* domain_end = nullptr;  ///< null: all functions are exact up to far
  std::uint32_t width = 0;
};

/// The block of a texel and the texel's index in it.
struct TexelAddress {
  const BlockPointers* block;
  std::uint32_t index;
};

/// One layer, channel and mip level of a view.
struct LevelImage {
  std::uint32_t width = 0, height = 0, blocks_across = 0;
  std::vector<BlockPointers> blocks;

  [[nodiscard]] TexelAddress address(std::uint32_t x, std::uint32_t y) const {
    const BlockPointers& block = blocks[std::size_t{y / kBlockSize} * blocks_across + x / kBlockSize];
    return {&block, y % kBlockSize * block.width + x % kBlockSize};
  }
};

struct PreparedView {
  View view;
  DepthRange range;
  double scale_x = 0, scale_y = 0;  ///< texels per unit of the window
  std::uint32_t level_count = 1;    ///< that all planes have
  /// By plane_of(layer, channel), then level.
  std::vector<std::vector<LevelImage>> planes;
};

/// Borrows the map.
[[nodiscard]] PreparedView prepare_view(const PenumbraMap& map, std::uint32_t index);

/// Where a point meets a view: what all planes share.
struct Place {
  const PreparedView* view = nullptr;  ///< null: nowhere, `status` tells why
  PointStatus status = PointStatus::outside;
  double u = 0, v = 0;          ///< texels of level 0 from the window's corner
  double texels_per_metre = 0;  ///< at the point's depth, along the finer axis
  bool is_lit = true;           ///< at near or before, where every function is 0
  CodeDepth z;                  ///< unless is_lit
};

/// The place of a point in the view's own space. NaNs and infinite depths are outside.
[[nodiscard]] Place place_in_view(const PreparedView& prepared, const std::array<double, 3>& p);

/// The place of a world point.
[[nodiscard]] Place place_in_world(const PreparedView& prepared, const std::array<double, 3>& p);

}  // namespace pdsm
