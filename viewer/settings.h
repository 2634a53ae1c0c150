// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pdsm/runtime/map_textures.h"

/// Everything that a person can change in the viewer, but for lights (light_set.h) and the camera.
namespace pdsm {

enum class Mode {
  shaded,      ///< as `pdsm render` draws it
  visibility,  ///< grey: the share of light that the maps let through
  truth,       ///< shaded with shadow rays in place of the maps
  error,       ///< heat map of |map - truth|
  slice,       ///< attenuation on a plane through the scene
  function     ///< shaded, with the attenuation function under the cursor
};

/// Words for --mode, in the order of the keys 1 to 6.
inline constexpr std::array<const char*, 6> kModeNames{"shaded", "visibility", "truth",
                                                       "error",  "slice",      "function"};

/// Which way the slice cuts: across a world axis, or across the light's direction.
enum class SliceAxis { x, y, z, depth };

struct Settings {
  Mode mode = Mode::shaded;

  Filter filter = Filter::bilinear;
  TextureLayout layout = TextureLayout::two_level;
  float normal_offset = 0;    ///< texels
  bool use_footprint = true;  ///< coarser levels far away, where maps have them

  bool object = true, particles = true, fog = false;
  bool paused = false;
  float object_size = 0.14F;  ///< radii of the focus, as all lengths here
  float path_radius = 0.9F;   ///< about the focus' centre
  float path_height = 0.3F;   ///< above the floor
  float fog_density = 0.8F;   ///< optical depth of a radius
  float fog_height = 1.3F;    ///< above the floor

  SliceAxis slice_axis = SliceAxis::z;
  float slice_position = 0.5F;  ///< 0..1 of the way through the scene, or from near to far
  bool slice_contours = true;

  std::uint32_t truth_samples = 256;  ///< shadow rays a pixel and light

  bool gizmos = true, frustum = false, plot = false;
  bool antialias = true;

  friend bool operator==(const Settings&, const Settings&) = default;
};

}  // namespace pdsm
