// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace pdsm {

/// A name that no file in the working folder has yet: pdsm-1.png, pdsm-2.png, ...
[[nodiscard]] std::filesystem::path free_screenshot_name();

}  // namespace pdsm
