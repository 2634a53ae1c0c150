// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "evaluate/quad_answers.h"
#include "evaluate/texel_quad.h"
#include "pdsm/bake/scene.h"
#include "tile/bake_job.h"

namespace pdsm {

/// Attenuations of a bake's own light samples by shadow rays, without any map; one value a point.
struct SampleRayValues {
  std::vector<double> at_point;  ///< at the point itself
  std::vector<double> biased;    ///< the same with the bake's bias
  std::vector<double> filtered;  ///< with the bias, on the quad's four rays at the point's depth, weighted
};

/// Traces them at world points with their quads; `job` gives samples and bias. A ray whose domain (of
/// `functions`) ends before the point's depth is asked at its end, as look-ups are held there. All threads;
/// the result does not depend on their number.
[[nodiscard]] SampleRayValues trace_sample_rays(const Scene& scene, const Light& light, const BakeJob& job,
                                                std::span<const glm::dvec3> points,
                                                std::span<const TexelQuad> quads,
                                                std::span<const QuadFunctions> functions);

}  // namespace pdsm
