// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>

namespace pdsm {

/// What a bake is asked to reach, in place of how it is to be made.
struct Goals {
  std::optional<double> target_error = {};  ///< verify()'s mean_abs_error, > 0
  std::optional<double> time_budget = {};   ///< seconds from the first trial to the last measurement, > 0
  std::optional<std::uint64_t> size_budget = {};  ///< bytes of the file

  [[nodiscard]] bool any() const { return target_error || time_budget || size_budget; }
};

/// Which options are kept as they are given; the others are chosen.
struct FixedOptions {
  bool samples = false, resolution = false, epsilon = false, map_resolution = false;
};

/// A goal can't be reached. what() is one line "--goal: reason".
class GoalMissed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pdsm
