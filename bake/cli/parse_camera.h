// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "evaluate/camera.h"

namespace pdsm {

/// The value of --camera: "EX,EY,EZ,TX,TY,TZ,FOV", fov in degrees of the picture's shorter side. Throws
/// Error (usage) "--camera: reason".
[[nodiscard]] Camera parse_camera(const std::string& text);

}  // namespace pdsm
