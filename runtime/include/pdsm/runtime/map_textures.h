// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pdsm/format/penumbra_map.h"
#include "pdsm/runtime/look_up.h"

/// Penumbra maps as textures, for any graphics API: plain arrays that runtime/shader/pdsm.glsl reads. Knows
/// no GL (the library pdsm::runtime_gl uploads them). All functions are pure and safe from any thread.
namespace pdsm {

/// Where the functions lie in the textures.
enum class TextureLayout {
  /// An index texel (first vertex, count) a PDSM texel, then all vertices back to back; binary search.
  /// Paper: Saint-Amour, "Penumbra Deep Shadow Maps", 2004, section 4.2.4.
  two_level,
  /// As many vertices for every texel as the longest function has, in slabs of four; linear search. The
  /// thesis' own (section 4.2.1), kept to compare with: it wastes memory on all shorter functions.
  fixed_depth
};

/// What the graphics API can hold. Defaults are what OpenGL ES 3.0 promises at least, but for the size.
struct TextureLimits {
  std::uint32_t texture_size = 16384;  ///< greatest width and height (GL_MAX_TEXTURE_SIZE)
};

/// Greatest numbers of maps and views in one set; their tables fill a uniform block of 16 KiB.
inline constexpr std::uint32_t kMaxShaderMaps = 64;
inline constexpr std::uint32_t kMaxShaderViews = 96;

/// How a map is looked up; may change from frame to frame without a new upload.
struct LookUpSettings {
  Filter filter = Filter::bilinear;
  /// The receiver is moved along its normal by this many texels (of the view, at its depth) before the
  /// look-up, >= 0. The bake's own bias is enough for what was baked; moving receivers may want some.
  float normal_offset = 0;
};

/// One map in the uniform block (std140, as the shader declares it).
struct ShaderMap {
  std::uint32_t first_view = 0, view_count = 0;
  std::uint32_t flags = 0;  ///< bit 0: bilinear; bit 1: layers add up; bit 2: three channels
  float normal_offset = 0;
};

/// One view in the uniform block (std140).
struct ShaderView {
  /// World (x, y, z, 1) to u * reach, v * reach (texels from the window's corner) and depth, where reach is
  /// the depth (perspective) or 1 (orthographic).
  std::array<std::array<float, 4>, 3> rows{};
  std::array<float, 4> depth{};          ///< near, depth codes per metre, largest code, 0
  std::array<float, 4> scale{};          ///< value_max; texels per unit of the window, the finer axis; 0, 0
  std::array<std::uint32_t, 4> image{};  ///< width, height (texels), planes, levels
  /// two_level: corner x and y in the index texture, first word in the vertex texture, count bits.
  /// fixed_depth: corner x and y in the vertex texture, slabs in a row, 0.
  std::array<std::uint32_t, 4> place{};
  std::uint32_t flags = 0;     ///< bit 0: orthographic
  std::uint32_t form = 1;      ///< words a vertex, 1 to 3: see pdsm.glsl
  std::uint32_t row_bits = 0;  ///< log2 of the vertex texture's width
  std::uint32_t slabs = 0;     ///< fixed_depth: slabs of four vertices a plane and level
};

/// The uniform block PdsmTables.
struct ShaderTables {
  std::array<ShaderMap, kMaxShaderMaps> maps{};
  std::array<ShaderView, kMaxShaderViews> views{};
};

/// One 2-D texture of 32-bit unsigned integers, rows back to back.
struct Texture {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 1;  ///< 1 (R32UI), 2 (RG32UI) or 4 (RGBA32UI)
  std::vector<std::uint32_t> words;

  [[nodiscard]] std::uint64_t bytes() const { return std::uint64_t{4} * words.size(); }
};

/// Everything that the shader needs of a set of maps.
struct MapTextures {
  TextureLayout layout = TextureLayout::two_level;
  Texture index;  ///< two_level only, else 1 x 1
  Texture vertices;
  ShaderTables tables;
  std::uint32_t map_count = 0;

  [[nodiscard]] std::uint64_t bytes() const { return index.bytes() + vertices.bytes(); }
};

/// Packs maps into textures; map n of the span is map n in the shader. Equal functions are stored once.
/// `origin` (metres, world space) is where the shader's positions are measured from: subtract it from world
/// positions in double, and scenes far from 0 lose nothing.
/// The maps have to hold their invariants (as all maps do that the reader returns). Throws Error (resource)
/// "maps[n]: reason" when a limit would be exceeded; a function is never cut.
[[nodiscard]] MapTextures make_map_textures(std::span<const PenumbraMap* const> maps, TextureLayout layout,
                                            const TextureLimits& limits = {},
                                            const std::array<double, 3>& origin = {0, 0, 0});

/// Changes how map `map` is looked up; the tables have to be uploaded again, the textures not.
void set_look_up(ShaderTables& tables, std::uint32_t map, const LookUpSettings& settings);

/// Lines for before pdsm.glsl that compile it for what these maps have in common (one vertex form, one layer,
/// no mip levels, ...): a shorter program, which is right for sets with the same lines alone.
[[nodiscard]] std::string shader_constants(const MapTextures& textures);

/// The text of pdsm.glsl; see there for what to define before it and what to call.
[[nodiscard]] std::string_view shader_text();

}  // namespace pdsm
