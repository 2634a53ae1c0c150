// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"
#include "truth/lit_surfaces.h"

namespace pdsm {

/// Finds where the central rays of a map's texels meet the last receiver: the surface that shows the whole
/// shadow. Closed meshes count where they face the light, open ones everywhere. Any thread.
class LastReceivers {
 public:
  /// Borrows `scene`, which must outlive it. Throws Error (resource) when Embree fails.
  LastReceivers(const Scene& scene, const View& view);

  /// The point on the last receiver surface that is not beyond far, world space; empty where there is none.
  [[nodiscard]] std::optional<glm::dvec3> find(const std::array<std::uint32_t, 2>& texel) const;

 private:
  const Scene& scene_;
  View view_;
  LitSurfaces surfaces_;
};

}  // namespace pdsm
