// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "choose/goals.h"
#include "choose/trial.h"

namespace pdsm {

/// How trials are measured: all at the same points, so that their differences are certain where they
/// themselves are not. A map for surfaces is measured on surfaces, as the verify command does.
[[nodiscard]] VerifyOptions trial_measure(const BakeOptions& options);

/// How the try of number `index` is judged: at points that nothing was chosen by, twice as many as
/// verify() takes, with shadow rays whose own error is small beside the target. `last` was measured with
/// `last_rays` a point. With a time budget, which counts measuring in, as a trial but for the points.
[[nodiscard]] VerifyOptions judging_measure(const BakeOptions& options, const Goals& goals, std::size_t index,
                                            const Trial& last, std::uint32_t last_rays);

}  // namespace pdsm
