// SPDX-License-Identifier: Apache-2.0
#include "function_probe.h"

#include <algorithm>

#include "evaluate/probe_points.h"
#include "pdsm/bake/scene.h"

namespace pdsm {
namespace {

/// The texel of an axis that holds a coordinate of the window.
std::uint32_t texel_of(double x, double low, double high, std::uint32_t count) {
  const double place = (x - low) / (high - low) * count;
  return std::min(static_cast<std::uint32_t>(std::max(place, 0.0)), count - 1);
}

/// A texel of an image: its block, and its number in it.
struct TexelPlace {
  const FunctionBlock* block;
  std::uint32_t texel;
};

TexelPlace place_in(const FunctionImage& image, std::uint32_t i, std::uint32_t j) {
  const std::uint32_t bx = i / kBlockSize, by = j / kBlockSize;
  const auto extent = block_extent(image.width, image.height, bx, by);
  return {&image.blocks[std::size_t{by} * image.blocks_across() + bx],
          j % kBlockSize * extent[0] + i % kBlockSize};
}

std::vector<ProbeVertex> vertices_of(const PenumbraMap& map, const View& view, const TexelPlace& place) {
  std::vector<ProbeVertex> vertices;
  for (const FunctionVertex& vertex : unpack_function(map.coding, *place.block, place.texel)) {
    vertices.push_back({decode_depth(view, map.coding, vertex.depth),
                        static_cast<double>(vertex.begin) / map.coding.value_max,
                        static_cast<double>(vertex.end) / map.coding.value_max});
  }
  return vertices;
}

/// Fills in the texel, its ray and its functions.
void read_texel(const PenumbraMap& map, const glm::dvec3& in_view, FunctionProbe& probe) {
  const View& view = map.views[probe.view];
  const auto& w = view.window;
  const bool perspective = view.projection == Projection::perspective;
  const double reach = perspective ? in_view.z : 1;
  probe.texel = {texel_of(in_view.x / reach, w[0], w[2], view.width),
                 texel_of(in_view.y / reach, w[1], w[3], view.height)};
  const glm::dvec3 centre(w[0] + (w[2] - w[0]) * (probe.texel[0] + 0.5) / view.width,
                          w[1] + (w[3] - w[1]) * (probe.texel[1] + 0.5) / view.height, 0);
  (perspective ? probe.slope : probe.offset) += centre;
  for (const FunctionImage& image : map.images) {
    if (image.view != probe.view || image.level != 0) continue;
    const TexelPlace place = place_in(image, probe.texel[0], probe.texel[1]);
    probe.layers.push_back(vertices_of(map, view, place));
    if (!place.block->domain_end.empty()) {
      const double end = decode_depth(view, map.coding, place.block->domain_end[place.texel]);
      probe.domain_end = std::min(probe.domain_end, end);
    }
  }
}

/// As FunctionVertex says what vertices mean.
double evaluate(const std::vector<ProbeVertex>& function, double depth) {
  const auto behind = std::lower_bound(function.begin(), function.end(), depth,
                                       [](const ProbeVertex& vertex, double z) { return vertex.depth < z; });
  if (behind == function.begin()) return 0;
  const ProbeVertex& piece = *(behind - 1);
  if (behind == function.end()) return piece.begin;
  const double share = (depth - piece.depth) / (behind->depth - piece.depth);
  return piece.begin + (piece.end - piece.begin) * share;
}

}  // namespace

std::optional<FunctionProbe> probe_function(const PenumbraMap& map, const glm::dvec3& point) {
  for (std::uint32_t v = 0; v < map.views.size(); ++v) {
    const View& view = map.views[v];
    const glm::dvec3 in_view = apply(view.world_to_view, point);
    if (!in_window(view, in_view)) continue;
    FunctionProbe probe;
    probe.view = v;
    probe.near_depth = view.near_depth;
    probe.far_depth = probe.domain_end = view.far_depth;
    probe.point_depth = in_view.z;
    probe.world_to_view = view.world_to_view;
    probe.layers_add = map.layer_rule == LayerRule::clamped_sum;
    read_texel(map, in_view, probe);
    return probe;
  }
  return std::nullopt;
}

double probe_value(const FunctionProbe& probe, double depth) {
  double total = 0;
  for (const std::vector<ProbeVertex>& layer : probe.layers) {
    const double value = evaluate(layer, depth);
    total = probe.layers_add ? std::min(1.0, total + value) : std::max(total, value);
  }
  return total;
}

}  // namespace pdsm
