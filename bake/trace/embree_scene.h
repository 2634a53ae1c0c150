// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <string>
#include <vector>

#include "trace/light_space.h"
#include "trace/traced_mesh.h"

namespace pdsm {

/// Ray masks of the baker's scene: casters that are whole, receivers, casters with holes and curves, casters
/// that let a part of the light through. Rays that ask for casters with holes carry CutoutRays
/// (trace/cutout_holes.h).
inline constexpr unsigned kCasterMask = 1, kReceiverMask = 2, kCutoutMask = 4, kTranslucentMask = 8;

/// The ISA that Embree will use when asked for `wanted` (empty: the best of this machine). Throws Error
/// (usage) for an unknown name or one that this machine lacks.
[[nodiscard]] std::string choose_isa(const std::string& wanted);

/// Embree's device and scenes over a light-space scene; the only owner of their handles. Borrows the
/// meshes: the LightSpaceScene must outlive it. After construction, any thread may trace.
class EmbreeScene {
 public:
  EmbreeScene(const LightSpaceScene& scene, const std::string& isa, unsigned threads);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  [[nodiscard]] RTCScene handle() const { return scene_; }
  /// The casters with holes and curves alone; null where there are none. Curves have the ids behind those of
  /// all meshes.
  [[nodiscard]] RTCScene cutouts() const { return cutouts_; }
  /// The translucent casters alone; null where there are none.
  [[nodiscard]] RTCScene translucent() const { return translucent_; }
  [[nodiscard]] const LightSpaceScene& geometry() const { return geometry_; }

 private:
  const LightSpaceScene& geometry_;
  std::vector<TracedMesh> traced_;  ///< in the order of its meshes; Embree holds pointers to them
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr, cutouts_ = nullptr, translucent_ = nullptr;
};

}  // namespace pdsm
