// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "evaluate/image_io.h"
#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"

/// Error over a map's window: at the last receiver on each texel's central ray, where the whole shadow shows.
namespace pdsm {

/// Error at one texel; NaN where its ray meets no receiver.
struct TexelError {
  float error = 0;  ///< look-up (bilinear) - truth
  float truth = 0;
};

/// Error of `map`, of `light`, at texels of its window, against `samples` shadow rays each. All threads; the
/// result does not depend on their number, nor a texel's on the others. Throws Error (input) for maps of
/// several views.
[[nodiscard]] std::vector<TexelError> measure_texels(const PenumbraMap& map, const Scene& scene,
                                                     const Light& light,
                                                     std::span<const std::array<std::uint32_t, 2>> texels,
                                                     std::uint32_t samples, std::uint64_t seed,
                                                     std::uint32_t view = 0);

/// All texels of a view, row by row from y0.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> all_texels(const View& view);

/// `count` texels, drawn with equal chances.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> draw_texels(const View& view, std::uint32_t count,
                                                                    std::uint64_t seed);

/// Sum |error| over all texels, divided by the number of those in shadow or penumbra.
/// Paper: Atty, Holzschuch, Lapierre, Hasenfratz, Hansen, Sillion, "Soft Shadow Maps: Efficient Sampling of
/// Light Source Visibility", 2005, section 4.2.1.
[[nodiscard]] double atty_error(std::span<const TexelError> errors);

/// |error| of all texels (row by row from y0) as a heat map with its scale, texel (0, 0) at the lower left;
/// the shadow shows faintly where nothing errs.
[[nodiscard]] RgbImage draw_window_errors(std::uint32_t width, std::uint32_t height,
                                          std::span<const TexelError> errors);

/// Signed error of all texels as plane Y of an EXR image, row 0 at +y, NaN where there is no receiver.
[[nodiscard]] FloatPlane window_error_plane(std::uint32_t width, std::uint32_t height,
                                            std::span<const TexelError> errors);

}  // namespace pdsm
