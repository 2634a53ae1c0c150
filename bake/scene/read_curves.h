// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "pdsm/bake/scene.h"
#include "scene/file_source.h"
#include "scene/json_fields.h"

namespace pdsm {

/// Reads an entry of a scene file's `curves` and its hair file, whose name counts from `folder`, into
/// `scene`. Throws Error (input) "file:field: reason".
void read_curves(const JsonFields& fields, const std::filesystem::path& folder, FileSource& files,
                 Scene& scene);

}  // namespace pdsm
