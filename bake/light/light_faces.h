// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "pdsm/bake/scene.h"

/// The views of a light's map. Most lights have one. A sphere or mesh light has the six faces of a cube, a
/// planar one with `faces: 5` those of half a cube, all with the light's centre as their origin:
///
///   0       along the light's +z
///   1 .. 4  along +x, -x, +y, -y, with the light's +z upwards; of half a cube what is in front of the light
///   5       along -z
///
/// Windows of these are 90 degrees and one texel more on each side, so that texel centres lie on both sides
/// of a seam. A two-sided planar light has all six, or 0 and 5 alone, each with its own window.
namespace pdsm {

/// One view while it is fitted and baked.
struct LightFace {
  Light light;  ///< turned so that the view looks along its direction; its shape stays as it was
  std::array<double, 3> reach{};        ///< half extents of the light's box along the view's axes
  glm::dmat3 to_light{1.0};             ///< view space to that of view 0: a signed permutation, exact
  std::uint32_t width = 0, height = 0;  ///< texels
  bool is_one_of_several = false;
  bool is_of_cube = false;  ///< with seams to others
  /// Of a view that looks along a planar light's plane: what the light is in front of, in view space.
  std::optional<glm::dvec3> front;

  /// What lies no farther before the light's plane is the emitter, where there is a `front`. Metres.
  [[nodiscard]] double emitter_skin() const;
  /// A point of view 0's space in this view's.
  [[nodiscard]] std::array<double, 3> from_light(const std::array<double, 3>& p) const;
};

/// The view `index` of `view_count(light)`, of a map of `width` x `height` texels in its first view. Throws
/// Error (input) for faces that the light can't have, a mesh that is none or a window besides several views,
/// (usage) where the map is too small for the seams.
[[nodiscard]] LightFace light_face(const Light& light, std::uint32_t index, std::uint32_t width,
                                   std::uint32_t height);

}  // namespace pdsm
