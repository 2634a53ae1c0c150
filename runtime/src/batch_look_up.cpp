// SPDX-License-Identifier: Apache-2.0
#include "batch_look_up.h"

#include <algorithm>

#include "batch_places.h"
#include "function_group.h"
#include "packed_vertices.h"
#include "shader_functions.h"

namespace pdsm {
namespace {

inline void prefetch(const void* address) {
#ifdef __GNUC__
  __builtin_prefetch(address);
#else
  static_cast<void>(address);
#endif
}

/// The steps of a batch. Points are known by their number in the batch.
template <typename Vertices, Filter kFilter>
class Batch {
 public:
  explicit Batch(const PreparedMap& map) : map_(map), value_max_(map.coding.value_max) {}

  /// `Value`: float, or one for each of red, green, blue.
  template <typename Value>
  void look_up(const std::array<double, 3>* points, std::size_t count, Value* attenuation) {
    for (std::uint32_t channel = 0; channel < map_.channels; ++channel)
      std::fill_n(totals_[channel].begin(), count, 0.0);
    std::fill_n(is_placed_.begin(), count, false);
    std::size_t left = count;
    for (std::size_t v = 0; v < map_.views.size() && left > 0; ++v) {
      const PreparedView& view = map_.views[v];
      place_batch(view, points, count, kFilter, places_);
      left -= find_depths(view.range, count);
      for (std::size_t plane = 0; plane < view.planes.size(); ++plane) {
        find_shadow(map_.starts[v][plane]);
        find_functions(view.planes[plane][0]);
        add_values(totals_[plane % map_.channels]);
      }
    }
    for (std::size_t n = 0; n < count; ++n) tell(n, attenuation[n]);
  }

 private:
  static constexpr std::size_t kTexels = kFilter == Filter::bilinear ? 4 : 1;

  void tell(std::size_t n, float& attenuation) const {
    // A map of one channel is what nearly all are.
    attenuation = map_.channels == 1 ? static_cast<float>(totals_[0][n] * map_.value_scale)
                                     : grey_of(map_, totals_of(n));
  }
  void tell(std::size_t n, std::array<float, 3>& attenuation) const {
    attenuation = rgb_of(map_, totals_of(n));
  }
  [[nodiscard]] std::array<double, 3> totals_of(std::size_t n) const {
    return {totals_[0][n], totals_[1][n], totals_[2][n]};
  }

  /// Depths of the points that are behind near, of those that this view is the first to hold. Returns how
  /// many it holds.
  std::size_t find_depths(const DepthRange& range, std::size_t count) {
    behind_near_count_ = 0;
    std::size_t held_count = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const double z = places_.z[n];
      if (z == kNotHeld || is_placed_[n]) continue;
      is_placed_[n] = true;
      ++held_count;
      if (z <= range.near_depth) continue;
      depths_[n] = encode_depth(range, z);
      behind_near_[behind_near_count_++] = static_cast<std::uint32_t>(n);
    }
    return held_count;
  }

  /// Those of them where a plane may have shadow. Every point is written down, and kept if the next one is
  /// written behind it: whether a point is lit can't be foreseen, so nothing branches.
  void find_shadow(const FunctionStarts& starts) {
    shadow_count_ = 0;
    for (std::size_t i = 0; i < behind_near_count_; ++i) {
      const std::uint32_t n = behind_near_[i];
      const bool is_lit =
          starts.are_lit<Vertices::kDepthBits>(places_.x_low[n], places_.y_low[n], depths_[n].whole);
      shadow_[shadow_count_] = n;
      shadow_count_ += is_lit ? 0 : 1;
    }
  }

  /// The functions of the points in shadow. Their vertices will have come when add_values asks for them.
  void find_functions(const LevelImage& image) {
    for (std::size_t i = 0; i < shadow_count_; ++i) {
      const std::uint32_t x = places_.x_low[shadow_[i]], y = places_.y_low[shadow_[i]];
      if constexpr (kFilter == Filter::bilinear) {
        const std::uint32_t right = std::min(x + 1, image.width - 1),
                            above = std::min(y + 1, image.height - 1);
        functions_[i] = {function_of<Vertices>(image, x, y), function_of<Vertices>(image, right, y),
                         function_of<Vertices>(image, x, above), function_of<Vertices>(image, right, above)};
      } else {
        functions_[i] = {function_of<Vertices>(image, x, y)};
      }
      for (const FunctionRange& function : functions_[i]) prefetch(function.words);
    }
  }

  /// Filtered values of the functions found, combined with those of the layers before.
  void add_values(std::array<double, kBatchSize>& totals) {
    shader::PlainFunctions text;
    for (std::size_t i = 0; i < shadow_count_; ++i) {
      const std::uint32_t n = shadow_[i];
      const auto values = evaluate_group<Vertices>(functions_[i], depths_[n]);
      double value = values[0];
      if constexpr (kFilter == Filter::bilinear)
        value = text.pdsm_mix(text.pdsm_mix(values[0], values[1], places_.x_share[n]),
                              text.pdsm_mix(values[2], values[3], places_.x_share[n]), places_.y_share[n]);
      totals[n] = map_.rule == LayerRule::maximum ? std::max(totals[n], value)
                                                  : std::min(totals[n] + value, value_max_);
    }
  }

  const PreparedMap& map_;
  double value_max_;
  std::array<bool, kBatchSize> is_placed_;  ///< by this view or one before
  PlaceBatch places_;
  std::array<CodeDepth, kBatchSize> depths_;
  std::array<std::uint32_t, kBatchSize> behind_near_, shadow_;  ///< numbers of points
  std::size_t behind_near_count_ = 0, shadow_count_ = 0;
  std::array<std::array<FunctionRange, kTexels>, kBatchSize> functions_;  ///< of shadow_
  /// By channel: all layers so far, as real-valued codes.
  std::array<std::array<double, kBatchSize>, 3> totals_{};
};

template <typename Vertices, Filter kFilter, typename Value>
void look_up_in_batches(const PreparedMap& map, std::span<const std::array<double, 3>> points,
                        std::span<Value> attenuation) {
  Batch<Vertices, kFilter> batch(map);
  for (std::size_t first = 0; first < points.size(); first += kBatchSize)
    batch.look_up(points.data() + first, std::min(kBatchSize, points.size() - first),
                  attenuation.data() + first);
}

template <typename Value>
void look_up_values(const PreparedMap& map, std::span<const std::array<double, 3>> world_points,
                    Filter filter, std::span<Value> attenuation) {
  with_vertices(map.coding, [&]<typename Vertices>(Vertices) {
    if (filter == Filter::bilinear)
      look_up_in_batches<Vertices, Filter::bilinear>(map, world_points, attenuation);
    else
      look_up_in_batches<Vertices, Filter::nearest>(map, world_points, attenuation);
  });
}

}  // namespace

void look_up_many(const PreparedMap& map, std::span<const std::array<double, 3>> world_points, Filter filter,
                  std::span<float> attenuation) {
  look_up_values(map, world_points, filter, attenuation);
}

void look_up_many(const PreparedMap& map, std::span<const std::array<double, 3>> world_points, Filter filter,
                  std::span<std::array<float, 3>> attenuation) {
  look_up_values(map, world_points, filter, attenuation);
}

}  // namespace pdsm
