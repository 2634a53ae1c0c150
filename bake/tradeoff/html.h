// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pdsm {

/// Text as it goes into HTML, between tags or into a quoted attribute.
[[nodiscard]] std::string html_text(std::string_view text);

/// Bytes in base 64, padded (RFC 4648).
[[nodiscard]] std::string base64(std::string_view bytes);

/// <img> with the picture in it: `bytes` of a type such as "image/png".
[[nodiscard]] std::string inline_image(std::string_view bytes, std::string_view type, std::string_view alt);

/// The same of a PNG file. Throws Error (resource) when it can't be read.
[[nodiscard]] std::string inline_png(const std::filesystem::path& file, std::string_view alt);

}  // namespace pdsm
