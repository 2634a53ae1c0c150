// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <vector>

#include "pdsm/bake/scene.h"
#include "truth/world_scene.h"

namespace pdsm {

/// The translucent casters of a WorldScene, for rays that go on behind them. It has nothing in common with
/// the baker's layers. Any thread.
class TranslucentSurfaces {
 public:
  /// A surface that a ray has crossed.
  struct Crossing {
    float t;
    unsigned geometry, triangle;
    bool at_edge;  ///< of the triangle, where its neighbour is met, too
    double opacity;
  };
  using Crossings = std::vector<Crossing>;

  /// Borrows the casters, which hold what `scene` does.
  TranslucentSurfaces(const Scene& scene, const WorldScene& casters);

  [[nodiscard]] bool empty() const { return surfaces_.empty(); }

  /// Within a filter: adds a lane's hit to the ray's crossings, or tells by false that it is opaque.
  bool cross(const RTCFilterFunctionNArguments& args, unsigned lane, Crossings& crossings) const;

  /// The share of a ray's light that all of its crossings together keep, whatever their order.
  [[nodiscard]] double share_kept(Crossings& crossings) const;

 private:
  struct Surface {
    double opacity = 1;
    std::shared_ptr<const CutoutMask> blending;  ///< null: the opacity is the same everywhere

    [[nodiscard]] bool is_opaque() const { return opacity == 1 && !blending; }
  };

  const WorldScene& casters_;
  std::vector<Surface> surfaces_;  ///< by geometry; empty where all are opaque
};

}  // namespace pdsm
