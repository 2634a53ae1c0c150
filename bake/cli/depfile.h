// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pdsm {

/// A rule without commands, as make and ninja read it: `target` depends on `inputs`, and each input is a
/// target too, so that one that is gone is no error. Spaces, #, $ and : are escaped. Throws Error (usage)
/// for a line break in a name, which no such file can hold.
[[nodiscard]] std::string depfile_text(const std::filesystem::path& target,
                                       const std::vector<std::filesystem::path>& inputs);

}  // namespace pdsm
