// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <string>
#include <unordered_map>

#include "function_reader.h"
#include "map_packing.h"
#include "vertex_forms.h"

namespace pdsm {
namespace {

/// Where a function's vertices are, in vertices from the first of its map.
struct IndexEntry {
  std::uint32_t first = 0, count = 0;
};

/// The vertices of one map back to back. Functions that are equal word for word are stored once.
class FunctionStore {
 public:
  explicit FunctionStore(std::uint32_t form) : form_(form) {}

  IndexEntry add(const VertexCoding& coding, const FunctionBlock& block, std::uint32_t first,
                 std::uint32_t count) {
    if (count == 0) return {};
    const std::size_t begin = words_.size();
    for (std::uint32_t n = 0; n < count; ++n)
      append_vertex(form_, vertex_of(coding, block, first + n), words_);
    most_ = std::max(most_, count);
    const std::string_view bytes = bytes_of(begin, words_.size());
    const auto [found, is_new] =
        seen_.try_emplace(std::hash<std::string_view>()(bytes), Range{begin, words_.size()});
    // Another function with the same hash keeps the entry: then this one is stored without being shared.
    if (is_new || bytes_of(found->second.begin, found->second.end) != bytes) return {vertex(begin), count};
    words_.resize(begin);
    return {vertex(found->second.begin), count};
  }

  [[nodiscard]] const std::vector<std::uint32_t>& words() const { return words_; }
  [[nodiscard]] std::uint32_t most() const { return most_; }

 private:
  struct Range {
    std::size_t begin, end;
  };
  [[nodiscard]] std::uint32_t vertex(std::size_t word) const {
    return static_cast<std::uint32_t>(word / form_);
  }
  [[nodiscard]] std::string_view bytes_of(std::size_t begin, std::size_t end) const {
    return {reinterpret_cast<const char*>(words_.data() + begin), (end - begin) * sizeof(std::uint32_t)};
  }

  std::uint32_t form_, most_ = 0;
  std::vector<std::uint32_t> words_;
  std::unordered_map<std::size_t, Range> seen_;
};

/// One plane and level of a view.
struct IndexImage {
  std::uint32_t view = 0;  ///< in the tables
  std::array<std::uint32_t, 2> corner{};
  std::uint32_t width = 0;
  std::vector<IndexEntry> entries;
};

struct PackedMap {
  std::vector<std::uint32_t> words;
  std::vector<IndexImage> images;
  std::uint32_t count_bits = 0;
  bool wide = false;  ///< first and count do not fit one word together
};

PackedMap pack_map(const PenumbraMap& map, std::size_t number, const ShaderTables& tables) {
  const std::uint32_t first_view = tables.maps[number].first_view;
  FunctionStore store(vertex_form(map.coding));
  PackedMap packed;
  for (const FunctionImage& image : map.images) {
    const ShaderView& view = tables.views[first_view + image.view];
    if (!is_packed(view, image)) continue;
    IndexImage& index = packed.images.emplace_back();
    index.view = first_view + image.view;
    index.corner = image_corner(view, plane_of(map, image), image.level);
    index.width = image.width;
    index.entries.reserve(std::size_t{image.width} * image.height);
    for_each_function(image, [&](std::uint32_t, std::uint32_t, std::uint32_t first, std::uint32_t count,
                                 const FunctionBlock& block) {
      index.entries.push_back(store.add(map.coding, block, first, count));
    });
  }
  packed.words = store.words();
  packed.count_bits = static_cast<std::uint32_t>(std::bit_width(store.most()));
  const std::uint64_t vertices = packed.words.size() / vertex_form(map.coding);
  packed.wide = vertices > 0 && (vertices - 1) >> (32 - packed.count_bits) != 0;
  return packed;
}

/// The smallest square-like texture of a width that is a power of two; `row_bits` is its logarithm.
Texture make_vertex_texture(std::span<const PackedMap> maps, const TextureLimits& limits,
                            std::uint32_t& row_bits) {
  std::uint64_t total = 0;
  std::size_t largest = 0;
  for (std::size_t n = 0; n < maps.size(); ++n) {
    total += maps[n].words.size();
    if (maps[n].words.size() > maps[largest].words.size()) largest = n;
  }
  const auto widest = static_cast<std::uint32_t>(std::bit_width(limits.texture_size)) - 1;
  row_bits = 0;
  while (row_bits < widest && std::uint64_t{1} << (2 * row_bits) < total) ++row_bits;
  const std::uint64_t rows =
      std::max<std::uint64_t>(1, (total + (std::uint64_t{1} << row_bits) - 1) >> row_bits);
  if (rows > limits.texture_size || total >> 32 != 0)
    refuse_map(largest, "the set needs " + std::to_string(total) + " words of vertices, a texture holds " +
                            std::to_string(std::uint64_t{limits.texture_size} << row_bits) +
                            "; this map takes most of them, " + std::to_string(maps[largest].words.size()));
  Texture texture;
  texture.width = 1U << row_bits;
  texture.height = static_cast<std::uint32_t>(rows);
  texture.words.reserve(rows << row_bits);
  for (const PackedMap& map : maps)
    texture.words.insert(texture.words.end(), map.words.begin(), map.words.end());
  texture.words.resize(rows << row_bits);
  return texture;
}

void write_index(const PackedMap& map, const ShaderTables& tables, Texture& texture) {
  for (const IndexImage& image : map.images) {
    const ShaderView& view = tables.views[image.view];
    for (std::size_t n = 0; n < image.entries.size(); ++n) {
      const std::size_t x = view.place[0] + image.corner[0] + n % image.width,
                        y = view.place[1] + image.corner[1] + n / image.width;
      std::uint32_t* texel = texture.words.data() + (y * texture.width + x) * texture.channels;
      const IndexEntry& entry = image.entries[n];
      if (texture.channels == 1) {
        texel[0] = entry.first << map.count_bits | entry.count;
      } else {
        texel[0] = entry.first;
        texel[1] = entry.count;
      }
    }
  }
}

}  // namespace

void pack_two_level(std::span<const PenumbraMap* const> maps, const TextureLimits& limits,
                    MapTextures& textures) {
  std::vector<PackedMap> packed;
  std::vector<std::array<std::uint32_t, 2>> sizes;
  std::vector<std::uint32_t> map_of;
  for (std::size_t n = 0; n < maps.size(); ++n) {
    packed.push_back(pack_map(*maps[n], n, textures.tables));
    for (std::size_t v = 0; v < maps[n]->views.size(); ++v) {
      sizes.push_back(image_size(textures.tables.views[sizes.size()]));
      map_of.push_back(static_cast<std::uint32_t>(n));
    }
  }
  std::uint32_t row_bits = 0;
  textures.vertices = make_vertex_texture(packed, limits, row_bits);

  const Atlas atlas = place_images(sizes, map_of, limits);
  const bool wide = std::any_of(packed.begin(), packed.end(), [](const PackedMap& map) { return map.wide; });
  textures.index.channels = wide ? 2 : 1;
  textures.index.width = std::max(1U, atlas.width);
  textures.index.height = std::max(1U, atlas.height);
  textures.index.words.resize(std::size_t{textures.index.width} * textures.index.height *
                              textures.index.channels);

  std::uint32_t first_word = 0, view = 0;
  for (std::size_t n = 0; n < maps.size(); ++n) {
    for (std::size_t v = 0; v < maps[n]->views.size(); ++v, ++view) {
      ShaderView& table = textures.tables.views[view];
      table.place = {atlas.corners[view][0], atlas.corners[view][1], first_word,
                     wide ? 0 : packed[n].count_bits};
      table.row_bits = row_bits;
    }
    write_index(packed[n], textures.tables, textures.index);
    first_word += static_cast<std::uint32_t>(packed[n].words.size());
  }
}

}  // namespace pdsm
