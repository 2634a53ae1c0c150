// SPDX-License-Identifier: Apache-2.0
#include "evaluate/light_model.h"

#include "truth/random.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

/// Apart from those of the truth (probed_truth.cpp).
constexpr std::uint64_t kModelStream = 16;

}  // namespace

ErrorPart measure_light_model(const Scene& scene, const Light& light, const ProbedTruth& truth,
                              const VerifyOptions& options) {
  const ShadowRays rays(scene, light, 0);
  const std::uint64_t seed = hash_bits(options.seed, kModelStream);
  std::vector<double> changes(truth.points.size());
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t n = 0; n < changes.size(); ++n)
    changes[n] =
        brightness(rays.model_rgb(truth.points[n], options.samples, hash_bits(seed, n))) - truth.value(n);
  return sum_up(changes, truth);
}

}  // namespace pdsm
