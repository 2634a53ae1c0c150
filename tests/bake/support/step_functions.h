// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "events/accumulate.h"
#include "fit/fit_rules.h"
#include "pdsm/format/penumbra_map.h"
#include "support/random.h"

namespace pdsm::test {

/// A view of given depths; nothing else of it matters to a fit.
[[nodiscard]] View depth_view(double near_depth, double far_depth);

/// The shapes that fits are tried on.
enum class Shape {
  single,      ///< one step, anywhere
  rising,      ///< the leading edge of a penumbra
  falling,     ///< blocked from near on, then freed
  hump,        ///< rises, falls and rises
  wandering,   ///< any counts
  blinking,    ///< 0 and N in turn
  first_code,  ///< all events within the first depth code (of 16 bits)
  last_code,   ///< all events within the last
  near_ends    ///< events within delta of near and of far
};
inline constexpr Shape kShapes[] = {Shape::single,     Shape::rising,    Shape::falling,
                                    Shape::hump,       Shape::wandering, Shape::blinking,
                                    Shape::first_code, Shape::last_code, Shape::near_ends};

/// A valid step function with up to `steps` steps between near and far.
[[nodiscard]] StepFunction random_steps(Random& random, Shape shape, const View& view,
                                        std::uint32_t sample_count, double delta, std::uint32_t steps);

/// V of a step function and its extremes over a window, in double, independent of the baker's tube.
class StepTruth {
 public:
  StepTruth(const StepFunction& function, std::uint32_t sample_count);

  /// Left-continuous: counts the steps with depth < z.
  [[nodiscard]] double at(double z) const { return value(segments_before(z)); }
  /// Least and greatest V(z + s), |s| <= delta.
  [[nodiscard]] double least(double z, double delta) const;
  [[nodiscard]] double greatest(double z, double delta) const;
  [[nodiscard]] std::span<const double> depths() const { return depth_; }
  [[nodiscard]] double last() const { return value(depth_.size()); }

 private:
  [[nodiscard]] std::size_t segments_before(double z) const;
  [[nodiscard]] double value(std::size_t segment) const { return least_[0][segment]; }
  /// Segments first .. last that meet [z - delta, z + delta].
  [[nodiscard]] std::pair<std::size_t, std::size_t> window(double z, double delta) const;

  std::vector<double> depth_;
  std::vector<std::vector<double>> least_, greatest_;  ///< [k][n]: over segments n .. n + 2^k - 1
};

/// Every depth at which a fitted function minus a bound of the tube can peak: vertices, and depths at delta
/// from an event; each with both of its sides.
[[nodiscard]] std::vector<double> critical_depths(const View& view, const VertexCoding& coding,
                                                  std::span<const FunctionVertex> vertices,
                                                  const StepTruth& truth, double delta);

/// Rounding of depths on the way from code to metres and back: a few steps of double at far.
[[nodiscard]] inline double depth_slack(const View& view) {
  return 0x1.0p-48 * view.far_depth;
}

/// The vertices as a file returns them.
[[nodiscard]] std::vector<FunctionVertex> pack_and_unpack(const VertexCoding& coding,
                                                          std::span<const FunctionVertex> vertices);

}  // namespace pdsm::test
