// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

/// The evaluator: depth to code space, search in a function, piece, filter. Plain terms only (numbers,
/// structs, ifs and loops), so that a shader can say the same line by line; what differs there is how a
/// vertex is fetched, which is the template parameter `Vertices` here:
///   std::uint32_t depth(n), begin(n), end(n)   codes of vertex n of the block
///
///        end |        /|
///            |       / |     piece n: from depth(n), exclusive, to depth(n + 1), inclusive
///      begin |      o  o-----
///            +------+--+-----> depth code
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

/// Attenuation, as a real-valued code, of the function of vertices first .. last - 1.
template <typename Vertices>
inline double evaluate_codes(const Vertices& vertices, std::uint32_t first, std::uint32_t last, CodeDepth z) {
  if (first == last || vertices.depth(first) > z.whole) return 0;

  // The piece that holds z is the last one that begins before it; halving without branches.
  std::uint32_t piece = first;
  std::uint32_t count = last - first;
  while (count > 1) {
    const std::uint32_t half = count / 2;
    piece += vertices.depth(piece + half) <= z.whole ? half : 0;
    count -= half;
  }
  const double begin = vertices.begin(piece);
  if (piece + 1 == last) return begin;

  const std::uint32_t depth = vertices.depth(piece);
  const double share = (static_cast<double>(z.whole - depth) + z.fraction) /
                       static_cast<double>(vertices.depth(piece + 1) - depth);
  return begin + (static_cast<double>(vertices.end(piece)) - begin) * share;
}

/// The four texels around a point, clamped to the image, and how far it is from the first to the second.
struct TexelQuad {
  std::uint32_t x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  double share_x = 0, share_y = 0;
};

/// One axis: `position` in texels from the border of the window, texel centres at n + 1/2.
inline void place_between(double position, std::uint32_t size, std::uint32_t& low, std::uint32_t& high,
                          double& share) {
  const double shifted = position - 0.5;
  if (shifted <= 0) {
    low = high = 0;
    share = 0;
  } else if (shifted >= static_cast<double>(size - 1)) {
    low = high = size - 1;
    share = 0;
  } else {
    low = static_cast<std::uint32_t>(shifted);
    high = low + 1;
    share = shifted - static_cast<double>(low);
  }
}

/// The texel of an axis that holds `position`; the far border belongs to the last one.
inline std::uint32_t hold_texel(double position, std::uint32_t size) {
  if (position <= 0) return 0;
  if (position >= static_cast<double>(size)) return size - 1;
  return static_cast<std::uint32_t>(position);
}

/// Results weighted, never depths.
inline double mix_quad(const TexelQuad& quad, double v00, double v10, double v01, double v11) {
  const double low = v00 + (v10 - v00) * quad.share_x;
  const double high = v01 + (v11 - v01) * quad.share_x;
  return low + (high - low) * quad.share_y;
}

}  // namespace pdsm
