// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "light/convex_clip.h"
#include "light/light_faces.h"
#include "pdsm/bake/scene.h"

namespace pdsm {

/// x0, y0, x1, y1 in window coordinates.
using Window = std::array<double, 4>;

/// How windows and a light's shape lie to each other in light space. Window coordinates are slopes as seen
/// from the centre of a planar light, metres under a distant one. With h the light's half extents, a disk's
/// bounding square (of a distant light tangents: its rays have the directions (d, 1), |d| <= h per axis):
///
/// Shadow of a caster at P with depth z, on receivers up to depth zr. From the point s of a planar light it
/// falls at s + (P - s) zr / z, so on the slope P / z - s (1 / z - 1 / zr); of a distant one at P + d (zr -
/// z). Over the whole light and all depths from z to zr that is, per axis,
///     [ (P - h) / z + h / zr,  (P + h) / z - h / zr ]       planar
///     [ P - h (zr - z),  P + h (zr - z) ]                   distant
/// Both ends are linear fractions of P, so over a triangle in front of the light they are found at corners.
///
/// Hull. What can block a point that the window [w0, w1] sees up to depth far lies, per axis, in
///     z w0 - h (1 - z / far)  <=  p  <=  z w1 + h (1 - z / far)       planar
///     w0 - h (far - z)        <=  p  <=  w1 + h (far - z)             distant
/// linear in z, so four half-spaces. Where the light reaches l before and behind the view's centre, as in all
/// views of a sphere and along the plane of a planar light, the hull is bounded by the pyramid's sides, moved
/// out until all of the light is inside: z w0 - h - |w0| l <= p. What a planar light has behind it is left
/// out.
class LightSpread {
 public:
  explicit LightSpread(const Light& light);
  explicit LightSpread(const LightFace& face);

  [[nodiscard]] bool distant() const { return distant_; }
  /// Where a window sees a point in front of the light.
  [[nodiscard]] std::array<double, 2> place(const glm::dvec3& p) const;
  /// Bounds of the shadow of a point on receivers up to `deepest`.
  [[nodiscard]] Window shadow(const glm::dvec3& p, double deepest) const;
  /// The hull of the light and of `window` at depth `far`.
  [[nodiscard]] ConvexRegion hull(const Window& window, double far) const;
  /// What `window` sees.
  [[nodiscard]] ConvexRegion pyramid(const Window& window) const;
  /// Whether light from any point of the emitter can arrive at the front of a triangle.
  [[nodiscard]] bool reaches_front(const std::array<glm::dvec3, 3>& triangle) const;
  /// Points whose hull holds all that light comes through, in the plane z = 0, on its way to what `window`
  /// sees up to depth `deepest`.
  [[nodiscard]] std::array<glm::dvec3, 4> corners(const Window& window, double deepest) const;

 private:
  [[nodiscard]] ConvexRegion hull_of(const std::array<double, 2>& h, double half_depth, const Window& window,
                                     double far) const;

  bool distant_;
  std::array<double, 2> half_;
  double half_depth_ = 0;              ///< of the light's box along z
  std::optional<HalfSpace> in_front_;  ///< of the light's plane, where the view looks along it
};

}  // namespace pdsm
