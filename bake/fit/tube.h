// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "events/accumulate.h"
#include "fit/fit_rules.h"

/// The tube that a fitted function has to stay in:
///   min over |s| <= delta of V(z + s) - epsilon  <=  V'(z)  <=  max over |s| <= delta of V(z + s) + epsilon
/// on the grid of depth codes, in scaled value codes. V is a step function, so both bounds are steps.
/// They are rounded inwards to whole codes: a function within this tube is within the real one.
namespace pdsm {

/// low <= V' <= high for depth codes in [begin, begin of the next run]; the last run never ends.
struct TubeRun {
  std::int64_t begin = 0, low = 0, high = 0;
};

/// Counts [least, greatest]; of no segment at all, if not told otherwise.
struct CountRange {
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max(), greatest = 0;
};

/// Room to work in; keep one a thread.
struct TubeWorkspace {
  std::vector<std::int64_t> opens, closes;  ///< of each segment of V, and an end
  std::vector<CountRange> older;            ///< of a range of segments that slides along V
};

/// The tube of V. Beyond its last step V is held, as the domain rule asks. O(steps).
void build_tube(const StepFunction& function, const FitRules& rules, TubeWorkspace& room,
                std::vector<TubeRun>& tube);

/// Depth codes [first, last].
struct CodeBand {
  std::int64_t first = 0, last = 0;
};

/// Lifts the bounds everywhere but in `bands`, which are in order and do not overlap: there V' may be any
/// attenuation.
void relax_tube(const FitRules& rules, std::span<const CodeBand> bands, std::vector<TubeRun>& tube);

}  // namespace pdsm
