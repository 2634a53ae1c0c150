// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "trace/caster_triangles.h"
#include "trace/sample_map.h"
#include "trace/triangle_kernel.h"

namespace pdsm {

/// Enters all casters at the packets of `image` that `mask` wants, but for slots `left_out`, in order. What
/// the other packets hold is of no meaning.
void enter_casters(const CasterTriangles& casters, const SampleShift& shift,
                   std::span<const std::uint32_t> left_out, const PacketMask& mask, DepthImage& image);

/// As trace_sample_map(), for a sample in the light's plane, by projecting `casters` instead of tracing rays:
/// what is nearest at each texel's centre. Slots `left_out`, in order, count as not there. `scene` is
/// asked by the slope limit, and for casters with holes, which are traced. `image` is room to work in. Depths
/// are those of the triangles' planes within 2^-9 texel of the centres.
std::uint64_t raster_sample_map(const EmbreeScene& scene, const CasterTriangles& casters, const MapGrid& grid,
                                const LightSample& sample, const MapBias& bias,
                                std::span<const std::uint32_t> left_out, const PacketMask& mask,
                                DepthImage& image, SampleMap& map, SlopeBiasStatistics& statistics);

}  // namespace pdsm
