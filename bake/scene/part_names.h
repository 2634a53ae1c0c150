// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace pdsm {

/// Of how many nodes a part knows the names, its own included. A bound, for hostile files nest them without
/// end.
inline constexpr std::size_t kMostNodeNames = 64;

/// What a part of a geometry file is called there; any name may be empty.
struct PartNames {
  std::vector<std::string> nodes;  ///< of its node, then of that one's parents, at most kMostNodeNames
  std::string material;

  /// Of the node itself.
  [[nodiscard]] std::string node() const { return nodes.empty() ? "" : nodes.front(); }
};

}  // namespace pdsm
