// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "pdsm/bake/bake.h"
#include "walk/ray_path.h"

/// Algorithm 3.1 of the thesis, written as plainly as it can be: the oracle of the tests. Nothing of it is
/// used by a bake, and it uses nothing of the walks but the path's law.
namespace pdsm {

/// Depth of the nearest occluder at a map texel.
using MapDepth = std::function<float(std::int64_t x, std::int64_t y)>;

/// An event: depth, +1 blocked or -1 unblocked.
using ReferenceEvent = std::pair<float, int>;

/// Inserts the events of one PDSM ray against one sample's map into an ordered set, per-ray scan
/// conversion, depths below `domain_end` only.
void insert_reference_events(const RayPath& path, Walk walk, const MapDepth& map, float domain_end,
                             std::multiset<ReferenceEvent>& events);

/// V = blocked / N just behind each depth, from ordered events.
[[nodiscard]] std::vector<std::pair<float, int>> accumulate_reference(
    const std::multiset<ReferenceEvent>& events);

}  // namespace pdsm
