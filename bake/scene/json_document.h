// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace pdsm {

/// Parses JSON with comments; a BOM and any line ends are accepted. Throws Error (input): "name:LINE: reason"
/// for text that is not JSON or numbers out of range, "name:path.to.key: ..." for a key given twice.
[[nodiscard]] nlohmann::json parse_json(const std::string& text, const std::string& name);

/// Whether brackets of JSON are nested deeper than `levels`, for readers that recurse. Of any text.
[[nodiscard]] bool is_nested_deeper(std::string_view text, std::size_t levels);

/// "a.b" of path "a" and key "b"; "b" of an empty path. The result is safe for a one-line message.
[[nodiscard]] std::string join_path(const std::string& path, const std::string& key);

/// "a[2]".
[[nodiscard]] std::string join_path(const std::string& path, std::size_t index);

}  // namespace pdsm
