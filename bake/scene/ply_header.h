// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pdsm {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// The header of a PLY file: what rows of numbers follow.
/// Format: Turk, "The PLY Polygon File Format", 1994.
struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes; the rows follow
};

/// Bytes of a binary number.
[[nodiscard]] std::size_t size_of(PlyType type);

/// Throws FormatFault "line N: reason".
[[nodiscard]] PlyHeader parse_ply_header(std::string_view bytes);

}  // namespace pdsm
