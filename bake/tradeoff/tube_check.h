// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "pdsm/bake/bake.h"

/// Whether fitted functions keep the promise of the fit (docs/maths.md, "The tube"): for every z
///   min over |s| <= delta of V(z + s) - epsilon  <=  V'(z)  <=  max over |s| <= delta of V(z + s) + epsilon
/// It looks at decoded functions alone and has nothing in common with the fit.
namespace pdsm {

/// A step function: 0 up to the first depth, then value[n] behind depth[n]. Depths increase strictly.
struct DepthSteps {
  std::vector<double> depth, value;
};

/// A function of straight pieces: 0 up to the first depth, then from begin[n] to end[n] over
/// (depth[n], depth[n + 1]]; the last piece holds begin[n] for ever.
struct DepthPieces {
  std::vector<double> depth, begin, end;
};

/// Rounding of attenuations in double: a few operations on numbers up to 1.
inline constexpr double kTubeSlack = 1e-12;

/// Least distance of `fitted` from the walls of the tube of `truth` over all depths behind `near_depth`;
/// < 0: it leaves the tube. Exact: between neighbouring vertices and depths at `delta` from a step, the walls
/// are constant and the function is straight. O(n log n).
[[nodiscard]] double tube_margin(const DepthSteps& truth, const DepthPieces& fitted, double near_depth,
                                 double epsilon, double delta);

/// What was checked of one map.
struct TubeCheck {
  std::uint64_t functions = 0;  ///< checked: all of the map
  std::uint64_t outside = 0;    ///< that leave their tube by more than kTubeSlack
  double worst_margin = std::numeric_limits<double>::infinity();  ///< least tube_margin

  void add(double margin);
  void add(const TubeCheck& other);
};

/// Checks every function of `fitted`, bakes of `light` that differ in epsilon alone, against a bake of the
/// same samples without loss: epsilon = 0, delta half a step of 32-bit depths. That bake runs here, with
/// `options` (of any of them), block by block. Throws as bake() does.
[[nodiscard]] std::vector<TubeCheck> check_tubes(const Scene& scene, const Light& light, BakeOptions options,
                                                 std::span<const BakedMap> fitted,
                                                 const BakeCallbacks& callbacks);

}  // namespace pdsm
