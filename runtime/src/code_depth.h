// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

/// Depths in code space, from metres in double: a point at a vertex, to the last bit, is at the vertex.
namespace pdsm {

/// A depth in code space: decoded(whole) < z <= decoded(whole + 1), `fraction` in (0, 1] of the step. All
/// comparisons with vertices are then among integers, and a jump is hit exactly.
struct CodeDepth {
  std::uint32_t whole = 0;
  double fraction = 0;
};

/// Constants of one view that turn metres into code space.
struct DepthRange {
  double near_depth = 0, far_depth = 1;
  double depth_max = 0;  ///< largest code
  double scale = 0;      ///< codes per metre
  /// Within this distance (in codes) of a whole code, rounding could matter and is made good.
  double tolerance = 0;
};

/// The same bits as decode_depth of the format library.
inline double decode_code(const DepthRange& range, double code) {
  if (code <= 0) return range.near_depth;
  if (code >= range.depth_max) return range.far_depth;
  return (range.near_depth * (range.depth_max - code) + range.far_depth * code) / range.depth_max;
}

/// The slow half of encode_depth: code and fraction by the decoded depths themselves.
inline CodeDepth settle_depth(const DepthRange& range, double z, double whole) {
  double below = decode_code(range, whole);
  while (below >= z && whole > 0) below = decode_code(range, whole -= 1);
  double above = decode_code(range, whole + 1);
  while (above < z && whole + 1 < range.depth_max) {
    below = above;
    above = decode_code(range, (whole += 1) + 1);
  }
  return {static_cast<std::uint32_t>(whole), (z - below) / (above - below)};
}

/// Code space of a depth near < z <= far; behind far the largest code and fraction 1.
inline CodeDepth encode_depth(const DepthRange& range, double z) {
  if (z > range.far_depth) return {static_cast<std::uint32_t>(range.depth_max), 1.0};
  const double code = (z - range.near_depth) * range.scale;
  double whole = static_cast<double>(static_cast<std::int64_t>(code));
  if (whole > range.depth_max - 1) whole = range.depth_max - 1;
  const double fraction = code - whole;
  if (fraction < range.tolerance || fraction > 1 - range.tolerance) return settle_depth(range, z, whole);
  return {static_cast<std::uint32_t>(whole), fraction};
}

}  // namespace pdsm
