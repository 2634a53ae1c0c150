// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace pdsm {

/// Why a document is not well-formed: an end tag that is none's, an element left open, a tag or an attribute
/// without its end. Empty when it is. `void_elements`: those that have no end tag (HTML's img, meta, br).
[[nodiscard]] std::string find_markup_fault(const std::string& document,
                                            const std::vector<std::string>& void_elements);

/// What makes a document reach outside itself: the attribute or words; empty when nothing does.
[[nodiscard]] std::string find_outside_reference(const std::string& document);

}  // namespace pdsm
