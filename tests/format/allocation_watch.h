// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace pdsm::testing {

/// Sees the largest piece of memory that this thread asks `new` for while the object lives.
class AllocationWatch {
 public:
  AllocationWatch();
  [[nodiscard]] std::size_t largest() const;
};

}  // namespace pdsm::testing
