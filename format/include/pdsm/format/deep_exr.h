// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "pdsm/format/penumbra_map.h"

/// OpenEXR deep images as the interchange form of a penumbra map (Nuke, Natron, oiiotool).
namespace pdsm {

/// Writes `map` as a multi-part deep scanline file, one part an image (layer, view, level). A deep sample
/// is a vertex of the function: Z (float, metres), and what makes the round trip exact: the integer codes
/// as uint channels. Row 0 is +y. Views, coding, light samples and metadata travel in header attributes.
/// Throws Error (resource) on failure to write, leaving an old file untouched.
void export_deep_exr(const PenumbraMap& map, const std::filesystem::path& path);

/// Reads what export_deep_exr wrote, bit for bit: import(export(map)) == map. Safe on any bytes.
/// Throws Error (input) "path:field: reason".
[[nodiscard]] PenumbraMap import_deep_exr(const std::filesystem::path& path);

}  // namespace pdsm
