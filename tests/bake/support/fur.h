// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "pdsm/bake/scene.h"
#include "support/random.h"

/// Curves made in memory.
namespace pdsm::test {

/// One strand through these points, whose fourth coordinates are radii.
[[nodiscard]] inline Curves one_strand(const std::vector<glm::vec4>& points,
                                       CurveShape shape = CurveShape::round) {
  auto strands = std::make_shared<Strands>();
  strands->points = points;
  for (std::uint32_t n = 1; n < points.size(); ++n) strands->segments.push_back(n - 1);
  Curves curves;
  curves.name = "hair";
  curves.strands = std::move(strands);
  curves.shape = shape;
  return curves;
}

/// Strands of three segments each, from a ball's surface outwards.
[[nodiscard]] inline Curves random_fur(const glm::dvec3& centre, double radius, int count,
                                       std::uint64_t seed) {
  Random random(seed);
  auto strands = std::make_shared<Strands>();
  for (int n = 0; n < count; ++n) {
    const glm::dvec3 outwards(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    glm::dvec3 at = centre + radius * outwards;
    for (int k = 0; k < 4; ++k) {
      if (k > 0) strands->segments.push_back(static_cast<std::uint32_t>(strands->points.size() - 1));
      strands->points.emplace_back(glm::vec3(at), static_cast<float>(random.uniform(0.002, 0.02)));
      at += 0.3 * radius * outwards + glm::dvec3(0, random.uniform(-0.05, 0.05), 0);
    }
  }
  Curves curves;
  curves.name = "fur";
  curves.strands = std::move(strands);
  return curves;
}

}  // namespace pdsm::test
