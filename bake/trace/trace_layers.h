// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "trace/layer_map.h"
#include "trace/sample_map.h"
#include "trace/volume_steps.h"

namespace pdsm {

/// Traces the translucent casters of `scene` and marches through `volumes` (none: no steps), before what
/// `map` holds: all that the ray of each texel meets, surfaces with the biases of opaque casters. Edges that
/// triangles of one mesh share count once. Where the mask doesn't want a packet, it gets no layers; no mask:
/// all are traced. Returns the number of rays. Any thread; each with a map of its own.
std::uint64_t trace_layers(const EmbreeScene& scene, VolumeLayers& volumes, const MapGrid& grid,
                           const LightSample& sample, const MapBias& bias, const PacketMask* mask,
                           const SampleMap& map, std::uint32_t unit, LayerMap& layers,
                           SlopeBiasStatistics& statistics);

}  // namespace pdsm
