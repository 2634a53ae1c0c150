// SPDX-License-Identifier: Apache-2.0
#include "prepared_view.h"

#include <algorithm>
#include <cmath>

#include "planes.h"

namespace pdsm {
namespace {

/// Rounding of a decoded depth, in units of the larger of near and far, with room to spare.
constexpr double kDepthRounding = 0x1p-50;
/// How much smaller the error of a fraction has to be than the fraction itself: below a float's rounding.
constexpr double kFractionPrecision = 0x1p25;

DepthRange make_range(const View& view, const VertexCoding& coding) {
  DepthRange range;
  range.near_depth = view.near_depth;
  range.far_depth = view.far_depth;
  range.depth_max = coding.depth_max();
  range.scale = range.depth_max / (view.far_depth - view.near_depth);
  const double largest = std::max(std::abs(view.near_depth), std::abs(view.far_depth));
  const double error = kDepthRounding * largest * range.scale;
  range.tolerance = std::clamp(error * kFractionPrecision, 0x1p-10, 0.5);
  return range;
}

LevelImage prepare_image(const FunctionImage& image) {
  LevelImage level;
  level.width = image.width;
  level.height = image.height;
  level.blocks_across = image.blocks_across();
  level.blocks.reserve(image.blocks.size());
  for (std::uint32_t b = 0; b < image.blocks.size(); ++b) {
    const FunctionBlock& block = image.blocks[b];
    const auto extent =
        block_extent(image.width, image.height, b % level.blocks_across, b / level.blocks_across);
    level.blocks.push_back({block.first.data(), block.words.data(),
                            block.domain_end.empty() ? nullptr : block.domain_end.data(), extent[0]});
  }
  return level;
}

/// The point in a view's own space.
std::array<double, 3> to_view(const RigidTransform& transform, const std::array<double, 3>& p) {
  const auto& r = transform.rotation;
  const auto& t = transform.translation;
  return {r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + t[0], r[3] * p[0] + r[4] * p[1] + r[5] * p[2] + t[1],
          r[6] * p[0] + r[7] * p[1] + r[8] * p[2] + t[2]};
}

}  // namespace

PreparedView prepare_view(const PenumbraMap& map, std::uint32_t index) {
  PreparedView prepared;
  const View& view = map.views[index];
  prepared.view = view;
  prepared.range = make_range(view, map.coding);
  prepared.scale_x = view.width / (view.window[2] - view.window[0]);
  prepared.scale_y = view.height / (view.window[3] - view.window[1]);
  prepared.level_count = level_count(map, index);
  prepared.planes.resize(plane_count(map));
  for (const FunctionImage& image : map.images)
    if (image.view == index && image.level < prepared.level_count)
      prepared.planes[plane_of(map, image)].push_back(prepare_image(image));
  return prepared;
}

Place place_in_view(const PreparedView& prepared, const std::array<double, 3>& p) {
  const View& view = prepared.view;
  const auto& window = view.window;
  const bool perspective = view.projection == Projection::perspective;
  Place place;
  if (perspective && p[2] <= 0) {
    place.status = PointStatus::behind;
    return place;
  }
  // The borders are scaled, not the point, so that a border given as tangent times z is met exactly.
  const double reach = perspective ? p[2] : 1;
  if (!(p[0] >= window[0] * reach && p[0] <= window[2] * reach && p[1] >= window[1] * reach &&
        p[1] <= window[3] * reach && std::isfinite(p[2])))
    return place;
  const double x = perspective ? p[0] / p[2] : p[0];
  const double y = perspective ? p[1] / p[2] : p[1];
  place.view = &prepared;
  place.u = (x - window[0]) * prepared.scale_x;
  place.v = (y - window[1]) * prepared.scale_y;
  place.texels_per_metre = std::max(prepared.scale_x, prepared.scale_y) / reach;
  place.status = p[2] < view.near_depth ? PointStatus::outside : PointStatus::inside;
  place.is_lit = p[2] <= view.near_depth;
  if (!place.is_lit) place.z = encode_depth(prepared.range, p[2]);
  return place;
}

Place place_in_world(const PreparedView& prepared, const std::array<double, 3>& p) {
  return place_in_view(prepared, to_view(prepared.view.world_to_view, p));
}

}  // namespace pdsm
