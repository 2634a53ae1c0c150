// SPDX-License-Identifier: Apache-2.0
#include "support/step_functions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pdsm::test {
namespace {

std::vector<float> draw_depths(Random& random, Shape shape, const View& view, double delta,
                               std::uint32_t steps) {
  const double near = view.near_depth, far = view.far_depth, code = (far - near) / 0xFFFF;
  std::vector<float> depths;
  for (std::uint32_t n = 0; n < steps; ++n) {
    double z = random.uniform(near, far);
    if (shape == Shape::first_code) z = random.uniform(near, near + code);
    if (shape == Shape::last_code) z = random.uniform(far - code, far);
    if (shape == Shape::near_ends) {
      const double reach = std::min(std::max(delta, code), far - near);
      z = random.chance(0.5) ? random.uniform(near, near + reach) : random.uniform(far - reach, far);
    }
    depths.push_back(static_cast<float>(z));
  }
  // What walks give: depths from float(near) on and before float(far).
  const auto first = static_cast<float>(near), last = std::nextafter(static_cast<float>(far), 0.0F);
  for (float& depth : depths) depth = std::clamp(depth, first, last);
  if (random.chance(0.3)) depths.front() = first;
  if (random.chance(0.3)) depths.back() = last;
  std::sort(depths.begin(), depths.end());
  depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
  return depths;
}

std::uint32_t draw_count(Random& random, Shape shape, std::uint32_t n, std::uint32_t steps,
                         std::uint32_t total) {
  const double share = static_cast<double>(n + 1) / steps, most = total;
  const auto part = [&](double x) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(x, 0.0, 1.0) * most));
  };
  switch (shape) {
    case Shape::single:
      return random.count(1, total);
    case Shape::rising:
      return part(share);
    case Shape::falling:
      return part(1 - share + 1.0 / steps);
    case Shape::hump:
      return part(std::abs(std::sin(5 * share)));
    case Shape::blinking:
      return n % 2 == 0 ? total : 0;
    default:
      return random.count(0, total);
  }
}

}  // namespace

View depth_view(double near_depth, double far_depth) {
  View view;
  view.near_depth = near_depth;
  view.far_depth = far_depth;
  view.width = view.height = 1;
  return view;
}

StepFunction random_steps(Random& random, Shape shape, const View& view, std::uint32_t sample_count,
                          double delta, std::uint32_t steps) {
  const std::uint32_t wanted = shape == Shape::single ? 1 : steps;
  const std::vector<float> depths = draw_depths(random, shape, view, delta, wanted);
  StepFunction function;
  std::uint32_t before = 0;
  for (std::uint32_t n = 0; n < depths.size(); ++n) {
    const std::uint32_t count =
        draw_count(random, shape, n, static_cast<std::uint32_t>(depths.size()), sample_count);
    if (count == before) continue;
    function.depth.push_back(depths[n]);
    function.count.push_back(count);
    before = count;
  }
  return function;
}

StepTruth::StepTruth(const StepFunction& function, std::uint32_t sample_count)
    : depth_(function.depth.begin(), function.depth.end()) {
  std::vector<double> values{0};
  for (const std::uint32_t count : function.count)
    values.push_back(static_cast<double>(count) / sample_count);
  least_ = greatest_ = {values};
  for (std::size_t run = 1; 2 * run <= values.size(); run *= 2) {
    const std::vector<double> low = least_.back(), high = greatest_.back();
    std::vector<double> lower, higher;
    for (std::size_t n = 0; n + 2 * run <= values.size(); ++n) {
      lower.push_back(std::min(low[n], low[n + run]));
      higher.push_back(std::max(high[n], high[n + run]));
    }
    least_.push_back(std::move(lower));
    greatest_.push_back(std::move(higher));
  }
}

std::size_t StepTruth::segments_before(double z) const {
  return static_cast<std::size_t>(std::lower_bound(depth_.begin(), depth_.end(), z) - depth_.begin());
}

std::pair<std::size_t, std::size_t> StepTruth::window(double z, double delta) const {
  // Segment k is (x_k, x_k+1]: it meets the window when x_k < z + delta and x_k+1 >= z - delta.
  return {segments_before(z - delta), segments_before(z + delta)};
}

double StepTruth::least(double z, double delta) const {
  const auto [first, last] = window(z, delta);
  std::size_t k = 0;
  while ((std::size_t{2} << k) <= last - first + 1) ++k;
  return std::min(least_[k][first], least_[k][last + 1 - (std::size_t{1} << k)]);
}

double StepTruth::greatest(double z, double delta) const {
  const auto [first, last] = window(z, delta);
  std::size_t k = 0;
  while ((std::size_t{2} << k) <= last - first + 1) ++k;
  return std::max(greatest_[k][first], greatest_[k][last + 1 - (std::size_t{1} << k)]);
}

std::vector<double> critical_depths(const View& view, const VertexCoding& coding,
                                    std::span<const FunctionVertex> vertices, const StepTruth& truth,
                                    double delta) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const double slack = depth_slack(view);
  std::vector<double> depths{view.near_depth, view.far_depth, 2 * view.far_depth};
  for (const FunctionVertex& vertex : vertices) {
    const double z = decode_depth(view, coding, vertex.depth);
    depths.insert(depths.end(), {std::nextafter(z, 0.0), z, std::nextafter(z, kFar)});
  }
  for (const double x : truth.depths()) {
    for (const double z : {x - delta, x, x + delta})
      depths.insert(depths.end(), {z - 2 * slack, z, z + 2 * slack});
  }
  std::erase_if(depths, [&](double z) { return z < view.near_depth; });
  return depths;
}

std::vector<FunctionVertex> pack_and_unpack(const VertexCoding& coding,
                                            std::span<const FunctionVertex> vertices) {
  std::vector<std::uint32_t> words(coding.words_per_vertex());
  std::vector<FunctionVertex> result;
  for (const FunctionVertex& vertex : vertices) {
    pack_vertex(coding, vertex, words.data());
    result.push_back(unpack_vertex(coding, words.data()));
  }
  return result;
}

}  // namespace pdsm::test
