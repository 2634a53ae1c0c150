// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"

/// Points at which a map is measured. All functions are pure: the same arguments give the same points.
/// Where there are several views, whose windows overlap by two texels, each point belongs to one.
namespace pdsm {

struct SurfaceProbes {
  std::vector<glm::dvec3> points;  ///< world space, metres
  std::uint64_t buried = 0;        ///< that were drawn and left out
};

/// Up to `count` points on the receivers of `scene` that lie in the windows of `views` and not beyond far,
/// uniform by area without holes. Closed meshes count where they face the light's centre, open ones
/// everywhere; neither does within (on all sides that count, a ten-thousandth of the depth off the surface) a
/// closed receiver, where nothing is seen. Fewer, down to none, when hardly any receiver surface qualifies.
/// Throws Error (resource) when Embree fails.
[[nodiscard]] SurfaceProbes surface_probes(const Scene& scene, std::span<const View> views,
                                           std::uint32_t count, std::uint64_t seed);

/// Up to `count` points in free space, uniform by volume in the windows' pyramids between near and the end
/// of the domain of the texel that holds them. World space, metres. Fewer when the domain is nearly empty.
[[nodiscard]] std::vector<glm::dvec3> free_probes(const PenumbraMap& map, std::uint32_t count,
                                                  std::uint64_t seed);

/// Depth (metres) up to which the function of texel (i, j) of a view is exact.
[[nodiscard]] double domain_end(const PenumbraMap& map, std::uint32_t view, std::uint32_t i, std::uint32_t j);

/// Whether a point in view space has slopes (perspective) or coordinates (orthographic) in the window.
[[nodiscard]] bool in_window(const View& view, const glm::dvec3& view_point);

}  // namespace pdsm
