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

/// One plane and level, filtered.
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
double evaluate_plane(const Place& place, const std::vector<LevelImage>& levels, double level,
                      Filter filter) {
  const auto fine = static_cast<std::uint32_t>(level);
  const double share = level - fine;
  const double value = evaluate_image<Vertices>(place, levels[fine], fine, filter);
  if (share == 0) return value;
  const double coarse = evaluate_image<Vertices>(place, levels[fine + 1], fine + 1, filter);
  return value + (coarse - value) * share;
}

/// Filtered attenuation of all layers at a place within a view, of one channel, as a real-valued code.
template <typename Vertices>
double evaluate_channel(const Place& place, const PreparedMap& map, std::uint32_t channel, Filter filter,
                        double footprint) {
  if (place.is_lit) return 0;
  double level = 0;
  if (footprint > 0)
    level = shader::PlainFunctions().pdsm_level(footprint * place.texels_per_metre, place.view->level_count);
  double total = 0;
  for (std::size_t plane = channel; plane < place.view->planes.size(); plane += map.channels) {
    const double value = evaluate_plane<Vertices>(place, place.view->planes[plane], level, filter);
    total = map.rule == LayerRule::maximum ? std::max(total, value)
                                           : std::min<double>(total + value, map.coding.value_max);
  }
  return total;
}

/// Whether the point lies past the domain of its texel's function in some plane.
bool is_past_end(const Place& place) {
  if (place.is_lit) return false;
  const auto last_code = static_cast<std::uint32_t>(place.view->range.depth_max);
  const auto& planes = place.view->planes;
  return std::any_of(planes.begin(), planes.end(), [&](const std::vector<LevelImage>& levels) {
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
  void evaluate(const Place& place, Filter filter, double footprint, LookUpResult& result) const;
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
void PenumbraLookUp::Prepared::evaluate(const Place& place, Filter filter, double footprint,
                                        LookUpResult& result) const {
  if (place.view == nullptr) return;
  std::array<double, 3> codes{};
  for (std::uint32_t channel = 0; channel < channels; ++channel)
    codes[channel] = evaluate_channel<Vertices>(place, *this, channel, filter, footprint);
  result.attenuation = grey_of(*this, codes);
  result.rgb = rgb_of(*this, codes);
}

LookUpResult PenumbraLookUp::Prepared::result(const Place& place, Filter filter, double footprint) const {
  LookUpResult result;
  result.status = place.status;
  with_vertices(coding,
                [&]<typename Vertices>(Vertices) { evaluate<Vertices>(place, filter, footprint, result); });
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

void PenumbraLookUp::attenuations(std::span<const std::array<double, 3>> world_points, Filter filter,
                                  std::span<std::array<float, 3>> rgb) const {
  assert(world_points.size() == rgb.size());
  look_up_many(*prepared_, world_points, filter, rgb);
}

}  // namespace pdsm
