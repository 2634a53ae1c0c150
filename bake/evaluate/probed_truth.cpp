// SPDX-License-Identifier: Apache-2.0
#include "evaluate/probed_truth.h"

#include <algorithm>
#include <utility>

#include "evaluate/probe_points.h"
#include "truth/random.h"

namespace pdsm {
namespace {

// Each use of randomness has its own stream of the seed.
enum Stream : std::uint64_t { kSurface, kFree, kTruthA, kTruthB };

}  // namespace

std::vector<double> ProbedTruth::values() const {
  std::vector<double> values(points.size());
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = value(n);
  return values;
}

std::size_t ProbedTruth::shadowed_points() const {
  std::size_t count = 0;
  for (std::size_t n = 0; n < points.size(); ++n) count += value(n) > 0 ? 1 : 0;
  return count;
}

ProbedTruth probe_truth(const PenumbraMap& map, const Scene& scene, const Light& light,
                        const VerifyOptions& options) {
  const std::uint32_t on_surfaces = options.free_space ? (options.points + 1) / 2 : options.points;
  ProbedTruth truth;
  SurfaceProbes on_receivers =
      surface_probes(scene, map.views, on_surfaces, hash_bits(options.seed, kSurface));
  truth.buried = on_receivers.buried;
  truth.points = std::move(on_receivers.points);
  truth.surface_points = truth.points.size();
  const std::vector<glm::dvec3> in_air =
      free_probes(map, options.points - on_surfaces, hash_bits(options.seed, kFree));
  truth.points.insert(truth.points.end(), in_air.begin(), in_air.end());

  const ShadowRays rays(scene, light, map.views.front().near_depth);
  const std::uint32_t half = std::max(1U, options.samples / 2);
  truth.a = rays.rgbs(truth.points, half, hash_bits(options.seed, kTruthA));
  truth.b = rays.rgbs(truth.points, half, hash_bits(options.seed, kTruthB));
  return truth;
}

}  // namespace pdsm
