// SPDX-License-Identifier: Apache-2.0
#include "screenshot.h"

#include <string>

namespace pdsm {

std::filesystem::path free_screenshot_name() {
  for (int number = 1;; ++number) {
    const std::filesystem::path name = "pdsm-" + std::to_string(number) + ".png";
    std::error_code ignored;
    if (!std::filesystem::exists(name, ignored)) return name;
  }
}

}  // namespace pdsm
