// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "evaluate/error_part.h"
#include "evaluate/probed_truth.h"
#include "pdsm/bake/scene.h"

namespace pdsm {

/// What the model of a sphere or mesh light, the body that its samples are taken from (docs/maths.md),
/// changes against what points see of it; with the truth's own error. `truth` is of probe_truth() with
/// `options`. Uses all threads; the result does not depend on their number.
[[nodiscard]] ErrorPart measure_light_model(const Scene& scene, const Light& light, const ProbedTruth& truth,
                                            const VerifyOptions& options);

}  // namespace pdsm
