// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace pdsm {

/// The first place at which `value` does not hold what `schema` says, "where: what"; empty when all holds.
/// Knows the keywords of our own schemas alone, and throws std::invalid_argument on any other.
[[nodiscard]] std::string schema_fault(const nlohmann::json& schema, const nlohmann::json& value);

}  // namespace pdsm
