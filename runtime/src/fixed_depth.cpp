// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "function_reader.h"
#include "map_packing.h"
#include "vertex_forms.h"

namespace pdsm {
namespace {

/// Channels of a texel: 128 bits, as in the thesis.
constexpr std::uint32_t kChannels = 4;

/// Vertices of a form in one texel.
std::uint32_t vertices_per_texel(std::uint32_t form) {
  return kChannels / form;
}

/// Slabs that the longest function of a map needs.
std::uint32_t slab_count(const PenumbraMap& map) {
  std::uint32_t most = 1;
  for (const FunctionImage& image : map.images)
    for_each_function(image, [&](std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t count,
                                 const FunctionBlock&) { most = std::max(most, count); });
  const std::uint32_t lanes = vertices_per_texel(vertex_form(map.coding));
  return (most + lanes - 1) / lanes;
}

/// The vertices of a function, filled up with repetitions of the last one: behind it, all mean its value. An
/// empty function is a vertex at depth code 0 of value 0.
std::vector<std::uint32_t> padded_words(const VertexCoding& coding, const FunctionBlock& block,
                                        std::uint32_t first, std::uint32_t count, std::uint32_t slabs) {
  const std::uint32_t form = vertex_form(coding), lanes = vertices_per_texel(form);
  std::vector<std::uint32_t> words;
  for (std::uint32_t n = 0; n < slabs * lanes; ++n) {
    const FunctionVertex vertex =
        count == 0 ? FunctionVertex{} : vertex_of(coding, block, first + std::min(n, count - 1));
    append_vertex(form, vertex, words);
    if (form == 3) words.push_back(0);
  }
  return words;
}

void write_image(const PenumbraMap& map, const FunctionImage& image, const ShaderView& view,
                 std::array<std::uint32_t, 2> slab_size, Texture& texture) {
  const auto corner = image_corner(view, plane_of(map, image), image.level);
  const std::uint32_t across = view.place[2];
  for_each_function(image, [&](std::uint32_t x, std::uint32_t y, std::uint32_t first, std::uint32_t count,
                               const FunctionBlock& block) {
    const std::vector<std::uint32_t> words = padded_words(map.coding, block, first, count, view.slabs);
    for (std::uint32_t s = 0; s < view.slabs; ++s) {
      const std::size_t column = view.place[0] + s % across * slab_size[0] + corner[0] + x,
                        row = view.place[1] + s / across * slab_size[1] + corner[1] + y;
      std::copy_n(words.data() + std::size_t{s} * kChannels, kChannels,
                  texture.words.data() + (row * texture.width + column) * kChannels);
    }
  });
}

}  // namespace

void pack_fixed_depth(std::span<const PenumbraMap* const> maps, const TextureLimits& limits,
                      MapTextures& textures) {
  textures.index = Texture{1, 1, 1, {0}};
  std::vector<std::array<std::uint32_t, 2>> sizes;
  std::vector<std::uint32_t> map_of;
  for (std::size_t n = 0; n < maps.size(); ++n) {
    const std::uint32_t slabs = slab_count(*maps[n]);
    for (std::size_t v = 0; v < maps[n]->views.size(); ++v) {
      ShaderView& view = textures.tables.views[sizes.size()];
      const auto size = image_size(view);
      // Slabs stand in a column while it is within the limit, then side by side.
      const std::uint32_t down = std::clamp(limits.texture_size / size[1], 1U, slabs);
      const std::uint32_t across = (slabs + down - 1) / down;
      view.slabs = slabs;
      view.place[2] = across;
      sizes.push_back({size[0] * across, size[1] * ((slabs + across - 1) / across)});
      map_of.push_back(static_cast<std::uint32_t>(n));
    }
  }
  const Atlas atlas = place_images(sizes, map_of, limits);
  textures.vertices.channels = kChannels;
  textures.vertices.width = std::max(1U, atlas.width);
  textures.vertices.height = std::max(1U, atlas.height);
  textures.vertices.words.resize(std::size_t{textures.vertices.width} * textures.vertices.height * kChannels);
  for (std::size_t v = 0; v < sizes.size(); ++v) {
    ShaderView& view = textures.tables.views[v];
    view.place[0] = atlas.corners[v][0];
    view.place[1] = atlas.corners[v][1];
    const PenumbraMap& map = *maps[map_of[v]];
    const std::uint32_t first_view = textures.tables.maps[map_of[v]].first_view;
    for (const FunctionImage& image : map.images)
      if (first_view + image.view == v && is_packed(view, image))
        write_image(map, image, view, image_size(view), textures.vertices);
  }
}

}  // namespace pdsm
