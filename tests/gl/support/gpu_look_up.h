// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "egl_context.h"
#include "float_points.h"

namespace pdsm::testing {

/// Runs the shader's own pdsm_attenuation (or another expression of `map`, `position` and `normal`) at points
/// on the GPU, and brings the bits back.
[[nodiscard]] std::vector<float> gpu_look_up(
    ShadowTextures& shadows, GlApi api, std::uint32_t map, const std::vector<FloatPoint>& points,
    const std::string& expression = "pdsm_attenuation(map, position)",
    ShaderScope scope = ShaderScope::any_maps);

/// The #version line of an API.
[[nodiscard]] std::string version_line(GlApi api);

}  // namespace pdsm::testing
