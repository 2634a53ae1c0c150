// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <vector>

#include "scene/format_fault.h"

namespace pdsm {

/// Element `index` of one of a glTF file's lists, such as its "accessors". Throws FormatFault where the list
/// has none.
template <typename T>
[[nodiscard]] const T& element(const std::vector<T>& all, int index, const char* list) {
  if (index < 0 || static_cast<std::size_t>(index) >= all.size())
    throw FormatFault(fmt::format("{}[{}] does not exist", list, index));
  return all[static_cast<std::size_t>(index)];
}

}  // namespace pdsm
