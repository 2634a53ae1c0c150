// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <array>

#include "pdsm/format/penumbra_map.h"
#include "trace/embree_scene.h"
#include "walk/map_grid.h"

namespace pdsm {

/// What is added to a map's depths so that a lit surface does not shadow itself. A map texel stands for
/// all points of the surface within `reach` texels of its centre; on a plane these are at most
/// `reach` times the depth's slope per texel behind it.
struct MapBias {
  double constant = 0;                    ///< metres, the same everywhere
  std::array<double, 2> reach{0.5, 0.5};  ///< map texels along x and y
  double limited_from = 0;                ///< metres: slopes that add more are kept before the next receiver
};

/// The bias of what the rays of one sample's map meet (docs/maths.md, "Bias").
class SurfaceBias {
 public:
  static constexpr int kLanes = 16;
  /// A shadow begins at the latest this share of the way from its caster to the next receiver behind it that
  /// faces the light. Half balances false shadow on the caster against leaks behind it (docs/maths.md).
  static constexpr float kWayToNext = 0.5F;
  /// Receivers nearer to the caster than this share of the constant bias are taken for the caster itself.
  static constexpr float kSameSurface = 0.25F;
  /// The same as a share of the depth: far above rounding, where the constant is 0.
  static constexpr float kLeastGap = 0x1p-18F;

  /// Borrows `scene`.
  SurfaceBias(const EmbreeScene& scene, const MapGrid& grid, const LightSample& sample, const MapBias& bias);

  [[nodiscard]] float constant() const { return constant_; }

  /// What each lane's surface adds for its slope, metres, into `slopes`; 0 for lanes that met nothing.
  /// `packet` holds rays that have been traced. Those whose slope adds more than is free are traced on to the
  /// next receiver.
  void slope_biases(const RTCRayHit16& packet, float* slopes) const;

 private:
  [[nodiscard]] float of_plane(const RTCRayHit16& packet, int lane) const;
  /// Curves receive nothing, and so need no bias for slopes.
  [[nodiscard]] bool is_curve(const RTCRayHit16& packet, int lane) const;
  void keep_before_next_receiver(const RTCRayHit16& packet, float* slopes) const;

  const EmbreeScene& scene_;
  float constant_, limited_from_, reach_x_, reach_y_, limit_;
  bool parallel_;  ///< the rays of a map are: those of a distant light
};

}  // namespace pdsm
