// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pdsm {

/// A rule without commands, as make and ninja read it: `target` depends on `inputs`, and each input is a
/// target too, so that one that is gone is no error, unless it has a % in its name. Spaces, #, $ and : are
/// escaped. Throws Error (usage) for what no such file can hold for both: a line break or a semicolon in a
/// name, a % in the target's.
[[nodiscard]] std::string depfile_text(const std::filesystem::path& target,
                                       const std::vector<std::filesystem::path>& inputs);

}  // namespace pdsm
