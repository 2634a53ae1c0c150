// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "pdsm/format/penumbra_map.h"

/// Look-up of baked attenuation on the CPU. Knows no Embree, no GL. All functions are pure and safe from
/// any number of threads on one PenumbraLookUp.
namespace pdsm {

enum class Filter {
  nearest,  ///< the function of the texel that holds the point
  bilinear  ///< the results (not the depths) of the four nearest texels' functions, weighted; edges clamp
};

/// Where a point lies with respect to a map.
enum class PointStatus {
  inside,   ///< in the window, within the functions' domain: the value is exact within the file's bound
  outside,  ///< outside the window, or before near: attenuation 0
  behind,   ///< behind the light: attenuation 0
  past_end  ///< past the last receiver on its texel's ray: the function's last value is held
};

struct LookUpResult {
  /// 0 lit .. 1 umbra. Of a map of three channels how bright they are together, 0.2126 red + 0.7152 green +
  /// 0.0722 blue (Rec. 709).
  float attenuation = 0;
  std::array<float, 3> rgb{};  ///< red, green, blue; of a map of one channel three times the same
  PointStatus status = PointStatus::outside;
};

/// A read-only view of a map, prepared for look-ups. Borrows the map: it must outlive this object and its
/// copies, which are cheap. Making one reads every texel once and takes two bytes a texel. The map has to
/// hold its invariants (find_invariant_fault), as all maps do that the reader returns. A point belongs to the
/// first view whose window holds it; each layer and channel is filtered by itself, then the layers combine by
/// the map's rule.
class PenumbraLookUp {
 public:
  explicit PenumbraLookUp(const PenumbraMap& map);

  /// Attenuation at a world point (metres). A point on the border of the window is inside. `footprint`:
  /// metres between neighbouring look-ups, >= 0; from 1.7 texels on (docs/runtime.md), maps with mip levels
  /// are asked at the two levels around it, blended.
  [[nodiscard]] LookUpResult at(const std::array<double, 3>& world_point, Filter filter,
                                double footprint = 0) const;

  /// The same at a point given in the space of view `view` (light space), for tools that are there already.
  [[nodiscard]] LookUpResult at_view_point(const std::array<double, 3>& view_point, Filter filter,
                                           std::uint32_t view = 0) const;

  /// Many at once, several times as fast: attenuation[n] = at(world_points[n]).attenuation, bit for bit, for
  /// points in any order, most so for 64 and more of them. Same length, else assert. Allocates nothing.
  void attenuations(std::span<const std::array<double, 3>> world_points, Filter filter,
                    std::span<float> attenuation) const;
  /// The same for rgb[n] = at(world_points[n]).rgb.
  void attenuations(std::span<const std::array<double, 3>> world_points, Filter filter,
                    std::span<std::array<float, 3>> rgb) const;

 private:
  struct Prepared;
  std::shared_ptr<const Prepared> prepared_;
};

}  // namespace pdsm
