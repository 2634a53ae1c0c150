// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// What a light emits by an OpenEXR, PNG, JPEG or TGA picture: colour, alpha left alone. Values of
/// pictures of 8 bits are sRGB. The picture's top row is at the light's +y. Throws FormatFault with the
/// reason.
[[nodiscard]] std::shared_ptr<const EmissionImage> read_emission(const std::string& bytes);

}  // namespace pdsm
