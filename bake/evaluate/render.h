// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "evaluate/camera.h"
#include "evaluate/image_io.h"
#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// Where a picture takes its attenuation from.
enum class ShadowSource {
  map,        ///< look-ups, bilinear
  truth,      ///< shadow rays
  difference  ///< both: shaded by the maps, and what differs is kept
};

/// A light of a picture.
struct PictureLight {
  const Light* light = nullptr;
  const PenumbraMap* map = nullptr;  ///< may be null for ShadowSource::truth
  double near_depth = 0;             ///< metres; see ShadowRays
};

struct RenderOptions {
  std::optional<Camera> camera;  ///< find_framing()'s otherwise
  std::uint32_t width = 960, height = 720;
  std::uint32_t supersample = 2;  ///< rays a pixel along each axis, 1 .. 8
  ShadowSource source = ShadowSource::map;
  std::uint32_t truth_samples = 256;
};

/// A rendered picture.
struct Picture {
  RgbImage linear;   ///< scene light
  RgbImage display;  ///< 0..1 display values
  /// ShadowSource::difference only: map - truth, mean over a pixel's rays, of the light where it is
  /// largest; NaN where a pixel shows no surface that a light shines on.
  std::vector<float> difference;
  std::vector<float> shade;  ///< lightness 0..1 without any shadow, for a backdrop
};

/// Numbers of a difference picture, over the pixels that show a surface that a light shines on.
struct DifferenceSummary {
  std::uint64_t pixels = 0;
  double mean_abs = 0, rms = 0, max = 0;
};

/// Renders a scene as the maps' users will see it: lights by a few fixed points each times visibility, a
/// soft sky, no randomness. Uses all threads; the result does not depend on their number.
[[nodiscard]] Picture render(const Scene& scene, std::span<const PictureLight> lights,
                             const RenderOptions& options);

[[nodiscard]] DifferenceSummary summarise_difference(std::span<const float> difference);

/// The difference as a heat map with its scale and numbers.
[[nodiscard]] RgbImage draw_difference(const Picture& picture);

}  // namespace pdsm
