// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pdsm/bake/scene.h"

/// Red, green and blue of a scene, each as a scene of one channel: what is baked and traced knows no colour.
/// Any thread.
namespace pdsm {

inline constexpr std::uint32_t kColourChannels = 3;

/// The geometry as light of channel `channel` (0 .. 2) meets it: without transmission, but with an opacity
/// and a mask that take what this one takes of the channel. Masks are rounded to 8 bits; the geometry
/// without transmission comes back as it is.
[[nodiscard]] Geometry channel_geometry(const Geometry& geometry, std::uint32_t channel);

/// The scene with all its geometry so, and no lights.
[[nodiscard]] Scene channel_scene(const Scene& scene, std::uint32_t channel);

/// Whether a light's picture gives channels shadows that differ by more than half a step of 8 bits: its
/// channels are so much elsewhere on the light. Two distributions of light that differ by a total variation
/// of t give attenuations that differ by t at most.
[[nodiscard]] bool is_coloured(const Light& light);

/// The light with what its picture emits in the channel as luminance; of a channel that it does not emit,
/// with its luminance. A light that is not coloured comes back as it is.
[[nodiscard]] Light channel_light(const Light& light, std::uint32_t channel);

/// Whether channels of a light's map may differ: the light or some caster, in its reach or not, is coloured.
[[nodiscard]] bool may_be_coloured(const Scene& scene, const Light& light);

}  // namespace pdsm
