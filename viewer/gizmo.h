// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "function_probe.h"
#include "line_batch.h"
#include "pdsm/format/penumbra_map.h"
#include "stage.h"

/// Lines that show what can't be seen: lights, what their maps cover, rays.
namespace pdsm {

/// The border of a light's emitter and an arrow along its direction.
void add_light_gizmo(LineBatch& lines, const Stage& stage, const Light& light, bool on);

/// The window of a view, from near to far.
void add_frustum(LineBatch& lines, const Stage& stage, const View& view);

/// The ray of a probed texel from near to far, as bright as the attenuation on it lets through.
void add_probe_ray(LineBatch& lines, const Stage& stage, const FunctionProbe& probe);

}  // namespace pdsm
