// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pdsm/bake/bake.h"

namespace pdsm::test {

/// A bake, decoded, with its functions at hand.
class BakedFunctions {
 public:
  BakedFunctions(const Scene& scene, const Light& light, const BakeOptions& options);

  [[nodiscard]] const PenumbraMap& map() const { return map_; }
  [[nodiscard]] const BakedMap& baked() const { return baked_; }
  [[nodiscard]] const BakeReport& report() const { return baked_.report; }
  [[nodiscard]] const View& view() const { return map_.views[0]; }

  [[nodiscard]] std::vector<FunctionVertex> function(std::uint32_t i, std::uint32_t j,
                                                     std::uint32_t level = 0) const;
  /// V' of a texel's own function, of maps without mip levels for any channel.
  [[nodiscard]] double value(std::uint32_t i, std::uint32_t j, double z, std::uint32_t channel = 0) const;
  /// End of a texel's domain as it is stored, metres; far if there is none.
  [[nodiscard]] double domain_end(std::uint32_t i, std::uint32_t j) const;
  /// The same as a depth code; empty if there is none.
  [[nodiscard]] std::optional<std::uint32_t> end_code(std::uint32_t i, std::uint32_t j,
                                                      std::uint32_t level = 0) const;
  /// Slope of a texel's central ray.
  [[nodiscard]] double slope_x(std::uint32_t i) const;
  [[nodiscard]] double slope_y(std::uint32_t j) const;
  /// Slope per texel of the sample maps.
  [[nodiscard]] double map_pitch_x() const;
  [[nodiscard]] double map_pitch_y() const;
  [[nodiscard]] std::uint64_t vertex_count() const;

 private:
  struct Place {
    const FunctionBlock* block;
    std::uint32_t texel;
  };
  [[nodiscard]] Place place(std::uint32_t i, std::uint32_t j, std::size_t image) const;

  BakedMap baked_;
  PenumbraMap map_;
};

/// Farthest that the point of a ray may be from the centre of the map texel that stands for it, in texels
/// along each axis: half a texel, and half a texel more across the midpoint line's major axis.
[[nodiscard]] inline double texel_reach(Walk walk) {
  return walk == Walk::exact ? 0.5 : 1.0;
}

/// Options that most tests start from: a small bake, for which one thread is fastest.
[[nodiscard]] BakeOptions small_options(std::uint32_t width, std::uint32_t height, std::uint32_t samples);

}  // namespace pdsm::test
