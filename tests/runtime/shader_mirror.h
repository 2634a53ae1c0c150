// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "pdsm/runtime/map_textures.h"

/// pdsm.glsl compiled as C++, over textures in memory: what a GPU with IEEE floats would say.
namespace pdsm::testing {

using std::ceil, std::log2, std::max, std::min;
using uint = std::uint32_t;
using uvec4 = std::array<std::uint32_t, 4>;

inline uvec4 fetch(const Texture& texture, uint x, uint y) {
  uvec4 texel{0, 0, 0, 1};
  const std::size_t at = (std::size_t{y} * texture.width + x) * texture.channels;
  for (std::uint32_t c = 0; c < texture.channels; ++c) texel[c] = texture.words.at(at + c);
  return texel;
}

struct MirrorInputs {
  explicit MirrorInputs(const MapTextures& textures)
      : pdsm_maps(textures.tables.maps), pdsm_views(textures.tables.views), textures_(textures) {}

  [[nodiscard]] uvec4 pdsm_index_texel(uint x, uint y) const { return fetch(textures_.index, x, y); }
  [[nodiscard]] uvec4 pdsm_vertex_texel(uint x, uint y) const { return fetch(textures_.vertices, x, y); }

  const std::array<ShaderMap, kMaxShaderMaps>& pdsm_maps;
  const std::array<ShaderView, kMaxShaderViews>& pdsm_views;

 private:
  const MapTextures& textures_;
};

#define PDSM_REAL float

struct TwoLevelMirror : MirrorInputs {
  using MirrorInputs::MirrorInputs;
#include "pdsm.glsl"
#undef PDSM_GLSL
};

struct FixedDepthMirror : MirrorInputs {
  using MirrorInputs::MirrorInputs;
#define PDSM_FIXED_DEPTH
#include "pdsm.glsl"
#undef PDSM_GLSL
#undef PDSM_FIXED_DEPTH
};

#undef PDSM_REAL

/// pdsm_attenuation at a world position.
inline float mirror_attenuation(const MapTextures& textures, std::uint32_t map, const std::array<float, 3>& p,
                                float footprint = 0) {
  if (textures.layout == TextureLayout::two_level)
    return TwoLevelMirror(textures).pdsm_attenuation_at(map, p[0], p[1], p[2], 0, 0, 0, footprint);
  return FixedDepthMirror(textures).pdsm_attenuation_at(map, p[0], p[1], p[2], 0, 0, 0, footprint);
}

}  // namespace pdsm::testing
