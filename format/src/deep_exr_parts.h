// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pdsm/format/penumbra_map.h"

/// What the two directions of the deep image agree on. FORMAT.md section 10.
namespace pdsm {

/// String attribute of part 0: the map with empty functions, as a map file, in hexadecimal digits.
inline constexpr const char* kShellAttribute = "pdsmMap";

inline constexpr const char* kDepthChannel = "pdsm.depth";
inline constexpr const char* kBeginChannel = "pdsm.begin";
inline constexpr const char* kEndChannel = "pdsm.end";
inline constexpr const char* kDomainEndChannel = "pdsm.domainEnd";

/// The map with every function empty and every domain end 0: all that the parts' pixels don't say.
[[nodiscard]] PenumbraMap make_shell(const PenumbraMap& map);

[[nodiscard]] bool has_domain_end(const FunctionImage& image);

/// Name of an image's part: layer, view, channel where there are several, level.
[[nodiscard]] std::string part_name(const PenumbraMap& map, const FunctionImage& image);

[[nodiscard]] std::string to_hex(std::span<const std::byte> bytes);
/// Empty where the text is not pairs of digits 0-9, a-f.
[[nodiscard]] std::optional<std::vector<std::byte>> from_hex(const std::string& text);

/// A texel's block and its index there.
struct TexelInBlock {
  std::size_t block;
  std::uint32_t texel;
};
[[nodiscard]] TexelInBlock find_texel(const FunctionImage& image, std::uint32_t x, std::uint32_t y);

}  // namespace pdsm
