// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "events/accumulate.h"
#include "events/event_log.h"
#include "events/gather_by_texel.h"

/// Events of bakes with translucent casters: a light sample's transmittance changes by so many units of 1/L.
/// A packed event (event_log.h) has 20 bits left above its texel; 0 there stands for L, the whole sample. So
/// the events of walks that meet opaque casters alone are what they are in any bake.
namespace pdsm {

/// L is at most this.
inline constexpr std::uint32_t kMostTransmittanceUnit = 1U << 20;

/// L of a bake of `samples` light samples: the greatest that keeps sums of all samples in 32 bits. Rounding
/// takes at most 1 / 2L of each sample, and so of their mean.
[[nodiscard]] inline std::uint32_t transmittance_unit(std::uint32_t samples) {
  return std::min(kMostTransmittanceUnit, ~0U / samples);
}

/// Where in a packed event the magnitude is, above 12 bits of texel.
inline constexpr int kMagnitudeShift = 44;

/// A change by `change` units, 1 .. `unit`.
[[nodiscard]] inline PackedEvent pack_change(std::uint32_t texel, float depth, std::uint32_t change,
                                             std::uint32_t unit, bool unblocks) {
  const PackedEvent magnitude = change == unit ? 0 : change;
  return magnitude << kMagnitudeShift | pack_event(texel, depth, unblocks);
}

/// Orders by depth: an EventKey, and below it the magnitude.
using ChangeKey = std::uint64_t;

using BlockChanges = TexelKeys<ChangeKey>;

/// gather_by_texel(); sum_changes() sorts what a texel has.
void gather_changes(std::span<const EventLog* const> logs, std::uint32_t texel_count, BlockChanges& changes);

/// As merge_quads(), of keys in any order: texels' keys follow each other.
void join_quads(const BlockChanges& texels, std::uint32_t width, std::uint32_t height, BlockChanges& quads);

/// Sorts the keys of one texel of mip level `level` and sums them up in integers: counts are in units of 1/L
/// of a light sample, the mean of the level's 4^level texels rounded to the nearest. Replaces the contents of
/// `function`.
void sum_changes(std::span<ChangeKey> keys, std::uint32_t unit, std::uint32_t level, StepFunction& function);

}  // namespace pdsm
