// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// The penumbra deep shadow map in memory: plain structs, no behaviour beyond decoding a code.
/// Everything here is immutable data once baked or read; any number of threads may read it.
///
/// A map holds, for every texel of a light-space image, one attenuation function V(z): which fraction
/// of the light (by emitting area) is blocked at depth z on the texel's ray.
/// Paper: Saint-Amour, Paquette, Poulin, "Penumbra Deep Shadow Maps", 2004.
namespace pdsm {

/// Functions are stored in square blocks of this edge, in texels; blocks at the right and upper border
/// are cut. A block is the unit of storage, not of baking.
inline constexpr std::uint32_t kBlockSize = 64;

/// A rigid motion p -> R p + t. `rotation` is row-major, orthonormal, with determinant +1.
struct RigidTransform {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 3> translation{0, 0, 0};
};

enum class Projection : std::uint32_t { perspective = 0, orthographic = 1 };

/// One image of a map. View space is light space for a planar light: origin at the centre of
/// projection, +z along the viewing direction, depth = z.
struct View {
  RigidTransform world_to_view;
  Projection projection = Projection::perspective;
  /// [x0, y0, x1, y1], x0 < x1, y0 < y1: tangents x/z, y/z (perspective) or metres (orthographic).
  std::array<double, 4> window{-1, -1, 1, 1};
  double near_depth = 0;                ///< metres; V = 0 up to here; 0 < near < far for perspective
  double far_depth = 1;                 ///< metres; beyond, a function holds its last value
  std::uint32_t width = 0, height = 0;  ///< texels, >= 1; texel (0,0) is at (x0, y0)

  friend bool operator==(const View&, const View&);
};

/// One point of the light that was sampled (perspective), or one direction (distant light).
struct LightSample {
  /// View space of view 0: metres, or under a distant light the direction of its rays, z = 1.
  std::array<double, 3> position{0, 0, 0};
  std::array<float, 2> jitter{0, 0};  ///< shift of this sample's map grid in map texels, [-0.5, 0.5)
  float weight = 1;                   ///< share of the light before normalising, >= 0

  friend bool operator==(const LightSample&, const LightSample&) = default;
};

/// How depths and attenuations are coded as integers, for all functions of a map.
///   depth       z = (near * (depth_max - d) + far * d) / depth_max, d = 0 .. depth_max
///   attenuation V = v / value_max, v = 0 .. value_max
/// Both ends of both ranges decode exactly.
struct VertexCoding {
  std::uint32_t depth_bits = 16;  ///< 16 or 32
  std::uint32_t value_bits = 8;   ///< 8, 16 or 32
  std::uint32_t value_max = 255;  ///< 1 .. 2^value_bits - 1

  [[nodiscard]] std::uint32_t depth_max() const { return depth_bits == 16 ? 0xFFFFu : 0xFFFFFFFFu; }
  /// 32-bit words a packed vertex takes: depth_bits + 2 * value_bits, rounded up.
  [[nodiscard]] std::uint32_t words_per_vertex() const { return (depth_bits + 2 * value_bits + 31) / 32; }
  friend bool operator==(const VertexCoding&, const VertexCoding&) = default;
};

/// One vertex of an attenuation function, unpacked.
/// Vertices d_0 < d_1 < ... of a function mean
///   V(z) = 0                                                       for z <= z_0
///   V(z) = begin_i + (end_i - begin_i) (z - z_i) / (z_i+1 - z_i)   for z_i < z <= z_i+1
///   V(z) = begin_last                                              for z > z_last
/// so that a jump is exact and V is left-continuous. The last vertex has begin = end. A function
/// without vertices is 0 everywhere.
struct FunctionVertex {
  std::uint32_t depth = 0;  ///< depth code at which this piece begins
  std::uint32_t begin = 0;  ///< value code just behind `depth`
  std::uint32_t end = 0;    ///< value code at the next vertex' depth

  friend bool operator==(const FunctionVertex&, const FunctionVertex&) = default;
};

/// The functions of one block, texels row by row from (x0, y0). All sizes as stated hold for every
/// block that the reader or the baker returns.
struct FunctionBlock {
  /// texel_count + 1 offsets in vertices: function t has vertices first[t] .. first[t + 1] - 1.
  std::vector<std::uint32_t> first;
  /// Packed vertices, `words_per_vertex` words each: little-endian bit string of depth, then begin and
  /// end; upper bits of the last word 0.
  std::vector<std::uint32_t> words;
  /// Depth code of each texel's end of domain (the last light-facing receiver surface on its ray,
  /// rounded up); empty when every function is exact up to far.
  std::vector<std::uint32_t> domain_end;

  friend bool operator==(const FunctionBlock&, const FunctionBlock&) = default;
};

/// All functions of one (layer, view, channel, mip level): blocks row by row.
///
/// Level l is for look-ups whose footprint is 2^l texels wide. Its texel (i, j) holds the mean, at each
/// depth, of the functions of the 2^l x 2^l texels (i 2^l, j 2^l) .. ((i + 1) 2^l - 1, (j + 1) 2^l - 1) of
/// level 0, each held behind its own end of domain; its end of domain is the greatest of theirs. What
/// 2^l x 2^l texels at a time leave over at the right and upper border is in no mean (of an axis of fewer
/// than 2^l texels, all are). A position of u texels
/// of level 0 from the lower corner is u / 2^l texels of level l from there, and what lies behind the centre
/// of the last texel is clamped to it, as at any border.
struct FunctionImage {
  std::uint32_t layer = 0, view = 0, channel = 0, level = 0;
  std::uint32_t width = 0, height = 0;  ///< texels; of level l: max(1, view size >> l)
  std::vector<FunctionBlock> blocks;    ///< blocks_across() * blocks_up()

  [[nodiscard]] std::uint32_t blocks_across() const { return (width + kBlockSize - 1) / kBlockSize; }
  [[nodiscard]] std::uint32_t blocks_up() const { return (height + kBlockSize - 1) / kBlockSize; }
  friend bool operator==(const FunctionImage&, const FunctionImage&) = default;
};

/// What tells whether a block of level 0, with its part of each mip level, is that of another bake too.
/// Nothing that a look-up needs.
struct BlockKey {
  /// A hash of all that the block was baked from; 0, 0 where that can't be told. Its value is the baker's.
  std::array<std::uint64_t, 2> inputs{};
  std::uint64_t content = 0;            ///< a hash of all else here and of the functions
  std::uint64_t events = 0;             ///< visibility events, of level 0
  std::uint32_t undarkened_texels = 0;  ///< texels whose rays nothing can darken

  /// Whether there is a key at all.
  [[nodiscard]] bool is_known() const { return inputs[0] != 0 || inputs[1] != 0; }
  friend bool operator==(const BlockKey&, const BlockKey&) = default;
};

/// How the layers of a light combine at look-up. The union of two casters' shadows is not a function of
/// the two attenuations; it lies between these two rules.
enum class LayerRule : std::uint32_t { maximum = 0, clamped_sum = 1 };

/// A penumbra deep shadow map. Images are ordered by layer, view, channel, level; each layer, view and
/// channel has levels 0, 1, ... without a gap, each once.
///
/// A map of three channels tells how much of the light's red, green and blue is blocked, each by functions of
/// its own: behind stained glass they differ, elsewhere they are equal and stored once.
struct PenumbraMap {
  std::vector<View> views;  ///< 1 or more
  std::vector<std::string> layers{"static"};
  LayerRule layer_rule = LayerRule::maximum;
  std::uint32_t channels = 1;  ///< 1 (all of the light), or 3 (red, green, blue)
  VertexCoding coding;
  std::vector<LightSample> samples;  ///< the samples it was baked from; may be empty (imported)
  std::vector<FunctionImage> images;
  /// One JSON object for people and tools: light, options, input hash, tool version, ISA, achieved
  /// error. Nothing that a look-up needs.
  std::string metadata = "{}";
  /// One for each block of image 0, or none: for bakes that take over what has not changed.
  std::vector<BlockKey> block_keys;

  friend bool operator==(const PenumbraMap&, const PenumbraMap&) = default;
};

/// Texels of block (bx, by) of an image of this size: width, height.
[[nodiscard]] std::array<std::uint32_t, 2> block_extent(std::uint32_t image_width, std::uint32_t image_height,
                                                        std::uint32_t bx, std::uint32_t by);

/// Depth of a code (see VertexCoding). Exact at both ends, monotone in between.
[[nodiscard]] double decode_depth(const View& view, const VertexCoding& coding, std::uint32_t depth);

/// Depth of one code step, metres.
[[nodiscard]] double depth_step(const View& view, const VertexCoding& coding);

/// Writes `vertex` to `words` (words_per_vertex of them); the codes must fit their bits.
void pack_vertex(const VertexCoding& coding, const FunctionVertex& vertex, std::uint32_t* words);

/// Inverse of pack_vertex.
[[nodiscard]] FunctionVertex unpack_vertex(const VertexCoding& coding, const std::uint32_t* words);

/// The vertices of function `texel` of a block, unpacked.
[[nodiscard]] std::vector<FunctionVertex> unpack_function(const VertexCoding& coding,
                                                          const FunctionBlock& block, std::uint32_t texel);

/// V of one function at depth z (metres), evaluated in double. Reference for tests and tools; the
/// runtime library has the fast one.
[[nodiscard]] double evaluate_function(const View& view, const VertexCoding& coding,
                                       std::span<const FunctionVertex> function, double z);

}  // namespace pdsm
