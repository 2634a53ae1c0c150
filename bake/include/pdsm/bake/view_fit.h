// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// A view of a light's map, fitted to the scene where the light leaves it open.
struct FittedView {
  View view;
  bool window_fitted = false, near_fitted = false, far_fitted = false;
  /// Share, by area, of the light-facing receiver surface in front of the light that lies outside the
  /// window, 0..1.
  double receivers_outside = 0;
  /// No caster lies in the hull of light and window: every function is empty.
  bool nothing_casts = false;
  /// No light-facing receiver lies in the window, in front of the light and up to far: the light reaches
  /// nothing of the scene. The view is fitted to casters then.
  bool nothing_receives = false;
  /// Of a view of a cube: casters lie before near, so that there are points before it, all lit in the
  /// map, that are not.
  bool casts_before_near = false;
};

/// Fits what is open.
///   window  the slopes (under a distant light, the places) at which a caster can darken a receiver, cut with
///           the receivers' own; slopes at most 120 degrees (|tangent| <= tan 60); a window that holds
///           everything that is not lit
///   near    depth of the nearest caster within the hull of light and window (not of the window alone);
///           geometry at or behind 1e-4 of it never blocks, but before a distant light all does
///   far     depth of the farthest receiver in the window (caster, if nothing receives)
/// Of a light of several views, the first is fitted; windows of cubes are given, and `receivers_outside` is
/// 0. `width`, `height`: texels. Throws Error (input) when near >= far is asked for, and for a distant light
/// whose position is not in front of its casters.
[[nodiscard]] FittedView fit_view(const Scene& scene, const Light& light, std::uint32_t width,
                                  std::uint32_t height);

}  // namespace pdsm
