// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "pdsm/bake/scene.h"
#include "scene/file_source.h"
#include "scene/json_fields.h"

namespace pdsm {

/// Reads an entry of a scene file's `volumes` and its grid, which files beside `folder` have, into `scene`:
/// a density as a volume, a level set as geometry. Throws Error (input) "file:field: reason".
void read_volume(const JsonFields& fields, const std::filesystem::path& folder, FileSource& files,
                 Scene& scene);

}  // namespace pdsm
