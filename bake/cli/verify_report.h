// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "evaluate/error_budget.h"
#include "evaluate/verify.h"

namespace pdsm {

/// What `pdsm verify` found out (docs/commands.md).
struct VerifyReport {
  VerifyResult result;
  double atty_error = 0;
  std::optional<ErrorBudget> budget;
  std::optional<ErrorPart> light;  ///< of sphere lights: what their model changes
};

[[nodiscard]] nlohmann::ordered_json verify_result_json(const VerifyResult& result);
[[nodiscard]] std::string verify_json(const VerifyReport& report);
[[nodiscard]] std::string verify_text(const VerifyReport& report);

}  // namespace pdsm
