// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <vector>

#include "scene/format_fault.h"

namespace pdsm {

/// Element `index` of one of a glTF file's lists; null where the list has none.
template <typename T>
[[nodiscard]] const T* find_element(const std::vector<T>& all, int index) {
  return index < 0 || static_cast<std::size_t>(index) >= all.size() ? nullptr
                                                                    : &all[static_cast<std::size_t>(index)];
}

/// The same of a list such as the "accessors". Throws FormatFault where the list has none.
template <typename T>
[[nodiscard]] const T& element(const std::vector<T>& all, int index, const char* list) {
  if (const T* found = find_element(all, index)) return *found;
  throw FormatFault(fmt::format("{}[{}] does not exist", list, index));
}

}  // namespace pdsm
