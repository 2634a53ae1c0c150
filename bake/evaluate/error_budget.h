// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "evaluate/error_part.h"
#include "evaluate/probed_truth.h"
#include "evaluate/verify.h"
#include "pdsm/bake/bake.h"
#include "pdsm/bake/scene.h"
#include "pdsm/format/penumbra_map.h"

/// What a map's error is made of (docs/maths.md, "Error budget").
namespace pdsm {

/// The parts of a map's error. At each point they add up to look-up minus truth (telescoping): each is the
/// difference of attenuations of which the later one lets one more cause in.
///   truth -> sampling -> filter -> map -> fit -> quantisation -> look-up
struct ErrorBudget {
  ErrorPart sampling;      ///< the light's N samples, by exact rays, instead of the whole light
  ErrorPart filter;        ///< four texels' rays at the point's depth, biased, instead of the point itself
  ErrorPart map;           ///< shadow maps of finite resolution instead of exact rays
  ErrorPart fit;           ///< few pieces within the tube, their values not rounded, instead of all steps
  ErrorPart quantisation;  ///< values rounded to the map's codes
  ErrorPart total;         ///< look-up - truth; its rms and bias are VerifyResult's
  /// Within `filter`, and no part of its own: what the bias against self-shadowing changes at the point
  /// itself.
  ErrorPart depth_bias;
  double root_sum_squares = 0;   ///< sqrt of the parts' summed rms^2: the total's rms were they independent
  double telescoping_fault = 0;  ///< largest |sum of a point's parts - its total|: rounding alone

  /// root_sum_squares by the total's rms; 1 when there is no error.
  [[nodiscard]] double ratio() const { return total.rms > 0 ? root_sum_squares / total.rms : 1; }
};

/// Measures the budget of `map`, which bake(scene, light, options) made, at the points that verify() takes.
/// Bakes the light again, once or twice, with what `options` says of memory and threads. Uses all threads;
/// the result does not depend on their number. Throws Error: (input) for maps of several views, or when
/// scene, light and options make another view or other samples than the map's; else as bake() does.
[[nodiscard]] ErrorBudget measure_error_budget(const PenumbraMap& map, const Scene& scene, const Light& light,
                                               const BakeOptions& options,
                                               const VerifyOptions& verify_options = {});

/// The same at points of which the truth is known already, from probe_truth() for this map.
[[nodiscard]] ErrorBudget measure_error_budget(const PenumbraMap& map, const Scene& scene, const Light& light,
                                               const BakeOptions& options, const ProbedTruth& truth);

}  // namespace pdsm
