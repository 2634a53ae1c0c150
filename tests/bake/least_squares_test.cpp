// SPDX-License-Identifier: Apache-2.0
// The line of a piece is the nearest to V in the mean square, in depth codes.
#include "fit/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/step_functions.h"

namespace pdsm::test {
namespace {

/// Integral of (line - V)^2 over codes [begin, end]: V is constant between steps and the square of a linear
/// function integrates exactly by Simpson's rule.
double squared_error(const StepFunction& function, const FitRules& rules, const PieceLine& line, double begin,
                     double end) {
  std::vector<double> borders{begin};
  for (const float depth : function.depth) {
    const double x = rules.code_of(depth);
    if (x > begin && x < end) borders.push_back(x);
  }
  borders.push_back(end);
  const StepTruth truth(function, rules.sample_count);
  const double scale = static_cast<double>(kValueScale) * rules.coding.value_max;
  double sum = 0;
  for (std::size_t n = 1; n < borders.size(); ++n) {
    const double x0 = borders[n - 1], x1 = borders[n], middle = (x0 + x1) / 2;
    const double value = scale * truth.at(rules.near_depth + middle / rules.codes_per_metre);
    const auto square = [&](double x) {
      return std::pow(line.begin + (line.end - line.begin) * (x - begin) / (end - begin) - value, 2);
    };
    sum += (square(x0) + 4 * square(middle) + square(x1)) * (x1 - x0) / 6;
  }
  return sum;
}

TEST(LeastSquares, NoOtherLineIsNearer) {
  Random random(91);
  const View view = depth_view(2, 9);
  for (int n = 0; n < 300; ++n) {
    const FitRules rules = make_fit_rules(view, 256, 0.02, 0.01);
    const StepFunction function = random_steps(
        random, random.pick({Shape::rising, Shape::falling, Shape::wandering}), view, 256, 0.01, 30);
    // Pieces in order, as the fit asks for them.
    std::size_t segment = 0;
    std::int64_t begin = 0;
    while (begin < 65000) {
      const std::int64_t end = begin + random.integer(1, 20000);
      const PieceLine best = least_squares_line(function, rules, begin, end, segment);
      const double least =
          squared_error(function, rules, best, static_cast<double>(begin), static_cast<double>(end));
      const double size = 256.0 * 255;
      // The error is quadratic about its minimum: any step away from it is worse (1e-9: rounding).
      for (const auto& [a, b] : {std::pair(1.0, 0.0), std::pair(-1.0, 0.0), std::pair(0.0, 1.0),
                                 std::pair(0.0, -1.0), std::pair(1.0, -1.0)}) {
        const PieceLine other{best.begin + a * size * 1e-3, best.end + b * size * 1e-3};
        const double error =
            squared_error(function, rules, other, static_cast<double>(begin), static_cast<double>(end));
        ASSERT_GT(error, least * (1 - 1e-9)) << "case " << n << ", codes " << begin << " to " << end;
      }
      begin = end;
    }
  }
}

}  // namespace
}  // namespace pdsm::test
