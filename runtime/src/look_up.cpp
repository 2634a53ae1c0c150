// SPDX-License-Identifier: Apache-2.0
#include "pdsm/runtime/look_up.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "code_depth.h"
#include "shader_functions.h"

namespace pdsm {
namespace {

/// A block's arrays, borrowed.
struct BlockPointers {
  const std::uint32_t* first = nullptr;
  const std::uint32_t* words = nullptr;
  const std::uint32_t* domain_end = nullptr;  ///< null: all functions are exact up to far
  std::uint32_t width = 0;
};

/// Level 0 of one layer of one view.
struct LayerImage {
  std::vector<BlockPointers> blocks;
};

/// One view, prepared: constants instead of divisions.
struct ViewLookUp {
  View view;
  DepthRange range;
  double scale_x = 0, scale_y = 0;  ///< texels per unit of the window
  std::uint32_t blocks_across = 0;
  std::vector<LayerImage> layers;
};

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

LayerImage make_layer(const FunctionImage& image) {
  LayerImage layer;
  layer.blocks.reserve(image.blocks.size());
  for (std::uint32_t b = 0; b < image.blocks.size(); ++b) {
    const FunctionBlock& block = image.blocks[b];
    const auto extent =
        block_extent(image.width, image.height, b % image.blocks_across(), b / image.blocks_across());
    layer.blocks.push_back({block.first.data(), block.words.data(),
                            block.domain_end.empty() ? nullptr : block.domain_end.data(), extent[0]});
  }
  return layer;
}

ViewLookUp make_view(const PenumbraMap& map, std::uint32_t index) {
  ViewLookUp prepared;
  const View& view = map.views[index];
  prepared.view = view;
  prepared.range = make_range(view, map.coding);
  prepared.scale_x = view.width / (view.window[2] - view.window[0]);
  prepared.scale_y = view.height / (view.window[3] - view.window[1]);
  prepared.blocks_across = (view.width + kBlockSize - 1) / kBlockSize;
  for (const FunctionImage& image : map.images)
    if (image.view == index && image.level == 0) prepared.layers.push_back(make_layer(image));
  return prepared;
}

/// Vertices of a block, coded with `DepthBits` and `ValueBits`: the compiler folds all shifts.
template <std::uint32_t DepthBits, std::uint32_t ValueBits>
struct PackedVertices {
  static constexpr std::uint32_t kStride = (DepthBits + 2 * ValueBits + 31) / 32;
  const std::uint32_t* words;

  [[nodiscard]] std::uint32_t depth(std::uint32_t n) const { return bits<0, DepthBits>(n); }
  [[nodiscard]] std::uint32_t begin(std::uint32_t n) const { return bits<DepthBits, ValueBits>(n); }
  [[nodiscard]] std::uint32_t end(std::uint32_t n) const { return bits<DepthBits + ValueBits, ValueBits>(n); }

 private:
  template <std::uint32_t Position, std::uint32_t Count>
  [[nodiscard]] std::uint32_t bits(std::uint32_t n) const {
    constexpr std::uint32_t kIndex = Position / 32, kShift = Position % 32;
    const std::uint32_t* vertex = words + std::size_t{n} * kStride;
    constexpr std::uint32_t kMask = ~std::uint32_t{0} >> (32 - Count);
    if constexpr (kShift + Count <= 32) {
      return vertex[kIndex] >> kShift & kMask;
    } else {
      const std::uint64_t value = vertex[kIndex] | std::uint64_t{vertex[kIndex + 1]} << 32;
      return static_cast<std::uint32_t>(value >> kShift) & kMask;
    }
  }
};

/// Where a point meets a view: what all layers share.
struct Place {
  const ViewLookUp* view = nullptr;  ///< null: nowhere, `status` tells why
  PointStatus status = PointStatus::outside;
  double u = 0, v = 0;  ///< texels from the window's corner
  bool is_lit = true;   ///< at near or before, where every function is 0
  CodeDepth z;          ///< unless is_lit
};

/// The point in a view's own space.
std::array<double, 3> to_view(const RigidTransform& transform, const std::array<double, 3>& p) {
  const auto& r = transform.rotation;
  const auto& t = transform.translation;
  return {r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + t[0], r[3] * p[0] + r[4] * p[1] + r[5] * p[2] + t[1],
          r[6] * p[0] + r[7] * p[1] + r[8] * p[2] + t[2]};
}

/// Finds the texel position of a point in view space. NaNs are outside.
Place place_in_view(const ViewLookUp& prepared, const std::array<double, 3>& p) {
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
        p[1] <= window[3] * reach && p[2] == p[2]))
    return place;
  const double x = perspective ? p[0] / p[2] : p[0];
  const double y = perspective ? p[1] / p[2] : p[1];
  place.view = &prepared;
  place.u = (x - window[0]) * prepared.scale_x;
  place.v = (y - window[1]) * prepared.scale_y;
  place.status = p[2] < view.near_depth ? PointStatus::outside : PointStatus::inside;
  place.is_lit = p[2] <= view.near_depth;
  if (!place.is_lit) place.z = encode_depth(prepared.range, p[2]);
  return place;
}

/// The block of a texel and the texel's index in it.
struct TexelAddress {
  const BlockPointers* block;
  std::uint32_t index;
};

TexelAddress address(const ViewLookUp& view, const LayerImage& layer, std::uint32_t x, std::uint32_t y) {
  const std::size_t b = std::size_t{y / kBlockSize} * view.blocks_across + x / kBlockSize;
  const BlockPointers& block = layer.blocks[b];
  return {&block, y % kBlockSize * block.width + x % kBlockSize};
}

/// The texels that a filter reads at a place, and their weights.
struct TexelQuad {
  shader::PlainFunctions::PdsmBetween x, y;
};

TexelQuad texels_of(const Place& place, Filter filter) {
  const View& view = place.view->view;
  shader::PlainFunctions text;
  if (filter == Filter::bilinear)
    return {text.pdsm_between(place.u, view.width), text.pdsm_between(place.v, view.height)};
  const std::uint32_t x = text.pdsm_holding(place.u, view.width), y = text.pdsm_holding(place.v, view.height);
  return {{x, x, 0}, {y, y, 0}};
}

/// The function of one texel at z, as a real-valued code.
template <typename Vertices>
double evaluate_texel(const ViewLookUp& view, const LayerImage& layer, std::uint32_t x, std::uint32_t y,
                      CodeDepth z) {
  const TexelAddress texel = address(view, layer, x, y);
  const std::uint32_t* first = texel.block->first + texel.index;
  shader::Functions<Vertices> functions{{texel.block->words}};
  return functions.pdsm_evaluate(0, {first[0], first[1] - first[0], 0}, {z.whole, z.fraction});
}

template <typename Vertices>
double evaluate_layer(const Place& place, const LayerImage& layer, const TexelQuad& quad, Filter filter) {
  const ViewLookUp& view = *place.view;
  const auto value = [&](std::uint32_t x, std::uint32_t y) {
    return evaluate_texel<Vertices>(view, layer, x, y, place.z);
  };
  const double v00 = value(quad.x.low, quad.y.low);
  if (filter == Filter::nearest) return v00;
  const double v10 = value(quad.x.high, quad.y.low), v01 = value(quad.x.low, quad.y.high),
               v11 = value(quad.x.high, quad.y.high);
  shader::PlainFunctions text;
  return text.pdsm_mix(text.pdsm_mix(v00, v10, quad.x.share), text.pdsm_mix(v01, v11, quad.x.share),
                       quad.y.share);
}

/// Filtered attenuation of all layers at a place within a view, as a real-valued code.
template <typename Vertices>
double evaluate_place(const Place& place, LayerRule rule, double value_max, Filter filter) {
  if (place.is_lit) return 0;
  const TexelQuad quad = texels_of(place, filter);
  double total = 0;
  for (const LayerImage& layer : place.view->layers) {
    const double value = evaluate_layer<Vertices>(place, layer, quad, filter);
    total = rule == LayerRule::maximum ? std::max(total, value) : std::min(total + value, value_max);
  }
  return total;
}

/// Whether the point lies past the domain of its texel's function in some layer.
bool is_past_end(const Place& place) {
  if (place.is_lit) return false;
  const ViewLookUp& view = *place.view;
  const TexelQuad quad = texels_of(place, Filter::nearest);
  return std::any_of(view.layers.begin(), view.layers.end(), [&](const LayerImage& layer) {
    const TexelAddress texel = address(view, layer, quad.x.low, quad.y.low);
    const std::uint32_t* ends = texel.block->domain_end;
    const auto last_code = static_cast<std::uint32_t>(view.range.depth_max);
    return place.z.whole >= (ends != nullptr ? ends[texel.index] : last_code);
  });
}

}  // namespace

struct PenumbraLookUp::Prepared {
  std::vector<ViewLookUp> views;
  VertexCoding coding;
  LayerRule rule = LayerRule::maximum;
  double value_scale = 1;  ///< attenuation of one value code

  [[nodiscard]] Place place(const std::array<double, 3>& world_point) const;
  template <typename Vertices>
  [[nodiscard]] float attenuation(const Place& place, Filter filter) const;
  [[nodiscard]] LookUpResult result(const Place& place, Filter filter) const;

  /// Calls `action` with a value of the PackedVertices type that `coding` asks for.
  template <typename Action>
  void with_vertices(Action action) const;
};

/// The first view whose window holds the point; behind only if it is behind all of them.
Place PenumbraLookUp::Prepared::place(const std::array<double, 3>& world_point) const {
  Place nowhere;
  nowhere.status = PointStatus::behind;
  for (const ViewLookUp& view : views) {
    const Place place = place_in_view(view, to_view(view.view.world_to_view, world_point));
    if (place.view != nullptr) return place;
    if (place.status != PointStatus::behind) nowhere.status = PointStatus::outside;
  }
  return nowhere;
}

template <typename Vertices>
float PenumbraLookUp::Prepared::attenuation(const Place& place, Filter filter) const {
  if (place.view == nullptr) return 0;
  const double code = evaluate_place<Vertices>(place, rule, coding.value_max, filter);
  return static_cast<float>(code * value_scale);
}

template <typename Action>
void PenumbraLookUp::Prepared::with_vertices(Action action) const {
  if (coding.depth_bits == 16) {
    if (coding.value_bits == 8) return action(PackedVertices<16, 8>{});
    if (coding.value_bits == 16) return action(PackedVertices<16, 16>{});
    return action(PackedVertices<16, 32>{});
  }
  if (coding.value_bits == 8) return action(PackedVertices<32, 8>{});
  if (coding.value_bits == 16) return action(PackedVertices<32, 16>{});
  return action(PackedVertices<32, 32>{});
}

LookUpResult PenumbraLookUp::Prepared::result(const Place& place, Filter filter) const {
  LookUpResult result;
  result.status = place.status;
  with_vertices(
      [&]<typename Vertices>(Vertices) { result.attenuation = attenuation<Vertices>(place, filter); });
  if (place.status == PointStatus::inside && is_past_end(place)) result.status = PointStatus::past_end;
  return result;
}

PenumbraLookUp::PenumbraLookUp(const PenumbraMap& map) {
  auto prepared = std::make_shared<Prepared>();
  prepared->coding = map.coding;
  prepared->rule = map.layer_rule;
  prepared->value_scale = 1 / static_cast<double>(map.coding.value_max);
  for (std::uint32_t view = 0; view < map.views.size(); ++view)
    prepared->views.push_back(make_view(map, view));
  prepared_ = std::move(prepared);
}

LookUpResult PenumbraLookUp::at(const std::array<double, 3>& world_point, Filter filter) const {
  return prepared_->result(prepared_->place(world_point), filter);
}

LookUpResult PenumbraLookUp::at_view_point(const std::array<double, 3>& view_point, Filter filter,
                                           std::uint32_t view) const {
  assert(view < prepared_->views.size());
  return prepared_->result(place_in_view(prepared_->views[view], view_point), filter);
}

void PenumbraLookUp::attenuations(std::span<const std::array<double, 3>> world_points, Filter filter,
                                  std::span<float> attenuation) const {
  assert(world_points.size() == attenuation.size());
  const Prepared& prepared = *prepared_;
  prepared.with_vertices([&]<typename Vertices>(Vertices) {
    for (std::size_t n = 0; n < world_points.size(); ++n)
      attenuation[n] = prepared.attenuation<Vertices>(prepared.place(world_points[n]), filter);
  });
}

}  // namespace pdsm
