// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"
#include "truth/shadow_rays.h"

namespace pdsm {

struct VerifyOptions {
  std::uint32_t points = 4000;   ///< half on surfaces, half in free space; >= 1
  bool free_space = true;        ///< false: all on surfaces, for maps that are exact there alone
  std::uint32_t samples = 4096;  ///< shadow rays a point; >= 2
  std::uint64_t seed = 0;
};

/// The same attenuation of all channels.
[[nodiscard]] inline std::array<double, 3> grey(double attenuation) {
  return {attenuation, attenuation, attenuation};
}

/// Points at which a map is measured, and the truth there: in two independent halves, whose mean is the
/// truth and whose difference tells its error.
struct ProbedTruth {
  std::vector<glm::dvec3> points;  ///< world, metres; those on surfaces first
  std::size_t surface_points = 0;
  std::uint64_t buried = 0;  ///< further points on surfaces, left out: within solids, where nothing is seen
  using Attenuations = std::array<double, 3>;  ///< of red, green and blue
  std::vector<Attenuations> a, b;

  [[nodiscard]] double value(std::size_t n, std::size_t channel) const {
    return 0.5 * (a[n][channel] + b[n][channel]);
  }
  /// Of how bright the channels are together.
  [[nodiscard]] double value(std::size_t n) const { return 0.5 * (brightness(a[n]) + brightness(b[n])); }
  [[nodiscard]] double squared_error(std::size_t n) const {
    const double difference = brightness(a[n]) - brightness(b[n]);
    return 0.25 * difference * difference;
  }
  [[nodiscard]] std::vector<double> values() const;
  [[nodiscard]] std::size_t shadowed_points() const;  ///< with true V > 0
};

/// Chooses the points for `map`, of `light`, and traces the truth. Uses all threads; the result does not
/// depend on their number.
[[nodiscard]] ProbedTruth probe_truth(const PenumbraMap& map, const Scene& scene, const Light& light,
                                      const VerifyOptions& options);

}  // namespace pdsm
