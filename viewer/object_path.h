// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "map_library.h"
#include "settings.h"
#include "stage.h"

namespace pdsm {

/// Chooses object_size, path_radius and path_height so that the moving object runs into as little as can be,
/// and passes through as much change from light to shadow.
void choose_path(const Stage& stage, const MapLibrary& library, Settings& settings);

}  // namespace pdsm
