// SPDX-License-Identifier: Apache-2.0
#include "pdsm/runtime/look_up.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "batch_look_up.h"
#include "packed_vertices.h"
#include "prepared_map.h"
#include "shader_functions.h"

namespace pdsm {
namespace {

/// The texels of one level that a filter reads at a place, and their weights.
struct TexelQuad {
  shader::PlainFunctions::PdsmBetween x, y;
};

TexelQuad texels_of(const Place& place, const LevelImage& image, std::uint32_t level, Filter filter) {
  shader::PlainFunctions text;
  const double shrink = 1.0 / static_cast<double>(std::uint32_t{1} << level);
  const double u = place.u * shrink, v = place.v * shrink;
  if (filter == Filter::bilinear)
    return {text.pdsm_between(u, image.width), text.pdsm_between(v, image.height)};
  const std::uint32_t x = text.pdsm_holding(u, image.width), y = text.pdsm_holding(v, image.height);
  return {{x, x, 0}, {y, y, 0}};
}

/// The function of one texel at z, as a real-valued code.
template <typename Vertices>
double evaluate_texel(const LevelImage& image, std::uint32_t x, std::uint32_t y, CodeDepth z) {
  const TexelAddress texel = image.address(x, y);
  const std::uint32_t* first = texel.block->first + texel.index;
  shader::Functions<Vertices> functions{{texel.block->words}};
  return functions.pdsm_evaluate(0, {first[0], first[1] - first[0], 0}, {z.whole, z.fraction});
}

/// One layer and level, filtered.
template <typename Vertices>
double evaluate_image(const Place& place, const LevelImage& image, std::uint32_t level, Filter filter) {
  const TexelQuad quad = texels_of(place, image, level, filter);
  const double v00 = evaluate_texel<Vertices>(image, quad.x.low, quad.y.low, place.z);
  if (filter == Filter::nearest) return v00;
  const double v10 = evaluate_texel<Vertices>(image, quad.x.high, quad.y.low, place.z);
  const double v01 = evaluate_texel<Vertices>(image, quad.x.low, quad.y.high, place.z);
  const double v11 = evaluate_texel<Vertices>(image, quad.x.high, quad.y.high, place.z);
  shader::PlainFunctions text;
  return text.pdsm_mix(text.pdsm_mix(v00, v10, quad.x.share), text.pdsm_mix(v01, v11, quad.x.share),
                       quad.y.share);
}

/// The levels between which a footprint lies, blended.
template <typename Vertices>
double evaluate_layer(const Place& place, const std::vector<LevelImage>& levels, double level,
                      Filter filter) {
  const auto fine = static_cast<std::uint32_t>(level);
  const double share = level - fine;
  const double value = evaluate_image<Vertices>(place, levels[fine], fine, filter);
  if (share == 0) return value;
  const double coarse = evaluate_image<Vertices>(place, levels[fine + 1], fine + 1, filter);
  return value + (coarse - value) * share;
}

/// Filtered attenuation of all layers at a place within a view, as a real-valued code.
template <typename Vertices>
double evaluate_place(const Place& place, LayerRule rule, double value_max, Filter filter, double footprint) {
  if (place.is_lit) return 0;
  double level = 0;
  if (footprint > 0)
    level = shader::PlainFunctions().pdsm_level(footprint * place.texels_per_metre, place.view->level_count);
  double total = 0;
  for (const auto& levels : place.view->layers) {
    const double value = evaluate_layer<Vertices>(place, levels, level, filter);
    total = rule == LayerRule::maximum ? std::max(total, value) : std::min(total + value, value_max);
  }
  return total;
}

/// Whether the point lies past the domain of its texel's function in some layer.
bool is_past_end(const Place& place) {
  if (place.is_lit) return false;
  const auto last_code = static_cast<std::uint32_t>(place.view->range.depth_max);
  const auto& layers = place.view->layers;
  return std::any_of(layers.begin(), layers.end(), [&](const std::vector<LevelImage>& levels) {
    const TexelQuad quad = texels_of(place, levels[0], 0, Filter::nearest);
    const TexelAddress texel = levels[0].address(quad.x.low, quad.y.low);
    const std::uint32_t* ends = texel.block->domain_end;
    return place.z.whole >= (ends != nullptr ? ends[texel.index] : last_code);
  });
}

}  // namespace

struct PenumbraLookUp::Prepared : PreparedMap {
  using PreparedMap::PreparedMap;

  [[nodiscard]] Place place(const std::array<double, 3>& world_point) const;
  template <typename Vertices>
  [[nodiscard]] float attenuation(const Place& place, Filter filter, double footprint) const;
  [[nodiscard]] LookUpResult result(const Place& place, Filter filter, double footprint) const;
};

/// The first view whose window holds the point; behind only if it is behind all of them.
Place PenumbraLookUp::Prepared::place(const std::array<double, 3>& world_point) const {
  Place nowhere;
  nowhere.status = PointStatus::behind;
  for (const PreparedView& view : views) {
    const Place place = place_in_world(view, world_point);
    if (place.view != nullptr) return place;
    if (place.status != PointStatus::behind) nowhere.status = PointStatus::outside;
  }
  return nowhere;
}

template <typename Vertices>
float PenumbraLookUp::Prepared::attenuation(const Place& place, Filter filter, double footprint) const {
  if (place.view == nullptr) return 0;
  const double code = evaluate_place<Vertices>(place, rule, coding.value_max, filter, footprint);
  return static_cast<float>(code * value_scale);
}

LookUpResult PenumbraLookUp::Prepared::result(const Place& place, Filter filter, double footprint) const {
  LookUpResult result;
  result.status = place.status;
  with_vertices(coding, [&]<typename Vertices>(Vertices) {
    result.attenuation = attenuation<Vertices>(place, filter, footprint);
  });
  if (place.status == PointStatus::inside && is_past_end(place)) result.status = PointStatus::past_end;
  return result;
}

PenumbraLookUp::PenumbraLookUp(const PenumbraMap& map) : prepared_(std::make_shared<Prepared>(map)) {}

LookUpResult PenumbraLookUp::at(const std::array<double, 3>& world_point, Filter filter,
                                double footprint) const {
  return prepared_->result(prepared_->place(world_point), filter, footprint);
}

LookUpResult PenumbraLookUp::at_view_point(const std::array<double, 3>& view_point, Filter filter,
                                           std::uint32_t view) const {
  assert(view < prepared_->views.size());
  return prepared_->result(place_in_view(prepared_->views[view], view_point), filter, 0);
}

void PenumbraLookUp::attenuations(std::span<const std::array<double, 3>> world_points, Filter filter,
                                  std::span<float> attenuation) const {
  assert(world_points.size() == attenuation.size());
  look_up_many(*prepared_, world_points, filter, attenuation);
}

}  // namespace pdsm
