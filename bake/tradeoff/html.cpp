// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/html.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <iterator>

#include "pdsm/format/error.h"

namespace pdsm {

std::string html_text(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    const std::size_t left = bytes.size() - n;
    std::uint32_t group = 0;
    for (std::size_t b = 0; b < 3; ++b)
      group = group << 8 | (b < left ? static_cast<unsigned char>(bytes[n + b]) : 0U);
    for (std::size_t d = 0; d < 4; ++d) text += d <= left ? kDigits[group >> (18 - 6 * d) & 63U] : '=';
  }
  return text;
}

std::string inline_image(std::string_view bytes, std::string_view type, std::string_view alt) {
  return fmt::format("<img alt=\"{}\" src=\"data:{};base64,{}\">", html_text(alt), type, base64(bytes));
}

std::string inline_png(const std::filesystem::path& file, std::string_view alt) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  if (!stream || bytes.empty()) throw Error(Failure::resource, file.string(), "can't be read back");
  return inline_image(bytes, "image/png", alt);
}

}  // namespace pdsm
