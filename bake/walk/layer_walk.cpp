// SPDX-License-Identifier: Apache-2.0
#include "walk/layer_walk.h"

#include <algorithm>

#include "events/transmittance_events.h"

namespace pdsm {
namespace {

/// The transmittance of a ray while it is walked.
class Transmittance {
 public:
  Transmittance(std::uint32_t unit, std::uint32_t texel, EventLog& log)
      : unit_(unit), now_(unit), texel_(texel), log_(log) {}

  void change(float depth, std::uint32_t to) {
    if (to == now_) return;
    const bool unblocks = to > now_;
    *log_.reserve(1) = pack_change(texel_, depth, unblocks ? to - now_ : now_ - to, unit_, unblocks);
    log_.commit(1);
    now_ = to;
  }

 private:
  const std::uint32_t unit_;
  std::uint32_t now_;
  const std::uint32_t texel_;
  EventLog& log_;
};

}  // namespace

void walk_layers(const LayeredMap& map, std::span<const WalkStep> steps, std::int64_t x, std::int64_t y,
                 std::uint32_t texel, float domain_end, EventLog& log) {
  Transmittance transmittance(map.unit, texel, log);
  for (const WalkStep& step : steps) {
    if (step.begin >= domain_end) return;
    const std::span<const Layer> layers = map.layers.at(x + step.dx, y + step.dy);
    const float opaque = map.opaque.at(x + step.dx, y + step.dy), end = std::min(step.end, domain_end);
    std::size_t n = 0;
    std::uint32_t at_begin = map.unit;
    for (; n < layers.size() && layers[n].depth <= step.begin; ++n) at_begin = layers[n].behind;
    transmittance.change(step.begin, opaque <= step.begin ? 0 : at_begin);
    for (; n < layers.size() && layers[n].depth < end; ++n)
      transmittance.change(layers[n].depth, layers[n].behind);
    if (opaque > step.begin && opaque < end) transmittance.change(opaque, 0);
  }
}

}  // namespace pdsm
