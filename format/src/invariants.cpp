// SPDX-License-Identifier: Apache-2.0
#include "invariants.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "faults.h"
#include "pdsm/format/map_file.h"
#include "vertex_bits.h"

namespace pdsm {
namespace {

/// How far R Rt may be from the identity. Composed doubles stay well below; a scale of 1.00001 does not.
constexpr double kRigidTolerance = 1e-6;

/// A step of the depth code has to be worth this many roundings of a depth, so that depths stay in order.
constexpr double kStepRoundings = 0x1p-48;

template <std::size_t N>
bool all_finite(const std::array<double, N>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

bool is_rigid(const RigidTransform& transform) {
  const auto& r = transform.rotation;
  if (!all_finite(r) || !all_finite(transform.translation)) return false;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const double dot = r[3 * a] * r[3 * b] + r[3 * a + 1] * r[3 * b + 1] + r[3 * a + 2] * r[3 * b + 2];
      if (!(std::abs(dot - (a == b ? 1 : 0)) <= kRigidTolerance)) return false;
    }
  }
  const double determinant = r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) +
                             r[2] * (r[3] * r[7] - r[4] * r[6]);
  return determinant > 0;
}

bool is_utf8(const std::string& text) {
  for (std::size_t n = 0; n < text.size();) {
    const auto lead = static_cast<unsigned char>(text[n]);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xC2 ? 0
                               : lead < 0xE0 ? 2
                               : lead < 0xF0 ? 3
                               : lead < 0xF5 ? 4
                                             : 0;
    if (length == 0 || text.size() - n < length || lead == 0) return false;
    for (std::size_t k = 1; k < length; ++k)
      if ((static_cast<unsigned char>(text[n + k]) & 0xC0) != 0x80) return false;
    n += length;
  }
  return true;
}

std::string at_texel(std::size_t texel, const char* what) {
  return std::string(what) + " (texel " + std::to_string(texel) + " of the block)";
}

/// One function: vertices `words` .. `words + count * stride`.
Verdict check_function(const VertexCoding& coding, const std::uint32_t* words, std::uint32_t count,
                       std::size_t texel) {
  const std::uint32_t stride = coding.words_per_vertex();
  const std::uint32_t used_bits = coding.depth_bits + 2 * coding.value_bits - 32 * (stride - 1);
  const std::uint32_t unused = used_bits == 32 ? 0 : ~std::uint32_t{0} << used_bits;
  FunctionVertex vertex;
  for (std::uint32_t n = 0; n < count; ++n, words += stride) {
    const std::uint32_t before = vertex.depth;
    vertex = load_vertex(coding, words);
    if ((words[stride - 1] & unused) != 0)
      return Violation{kFaultVertexBits, at_texel(texel, "unused bits of a vertex 0")};
    if (n > 0 && vertex.depth <= before)
      return Violation{kFaultVertexDepth, at_texel(texel, "depths that increase strictly")};
    if (vertex.begin > coding.value_max || vertex.end > coding.value_max)
      return Violation{kFaultVertexValue, at_texel(texel, "attenuations of at most value_max")};
  }
  if (count > 0 && vertex.begin != vertex.end)
    return Violation{kFaultLastVertex, at_texel(texel, "a constant last piece (begin = end)")};
  return {};
}

}  // namespace

Verdict check_coding(const VertexCoding& coding) {
  const auto violation = [](const char* expected) { return Violation{kFaultCoding, expected}; };
  if (coding.depth_bits != 16 && coding.depth_bits != 32) return violation("16 or 32 depth bits");
  if (coding.value_bits != 8 && coding.value_bits != 16 && coding.value_bits != 32)
    return violation("8, 16 or 32 value bits");
  const std::uint64_t limit = (std::uint64_t{1} << coding.value_bits) - 1;
  if (coding.value_max < 1 || coding.value_max > limit)
    return violation("value_max of 1 to 2^value_bits - 1");
  return {};
}

Verdict check_view(const View& view, const VertexCoding& coding) {
  const auto violation = [](const char* expected) { return Violation{kFaultView, expected}; };
  if (view.projection != Projection::perspective && view.projection != Projection::orthographic)
    return violation("projection 0 or 1");
  if (!is_rigid(view.world_to_view))
    return violation("a finite rigid world-to-view transform of determinant +1");
  const auto& window = view.window;
  if (!all_finite(window) || !(window[0] < window[2]) || !(window[1] < window[3]) ||
      !std::isfinite(window[2] - window[0]) || !std::isfinite(window[3] - window[1]))
    return violation("a finite window, x0 < x1, y0 < y1");
  // A look-up multiplies by these; an infinite one times a distance of 0 would be no position.
  if (!std::isfinite(view.width / (window[2] - window[0])) ||
      !std::isfinite(view.height / (window[3] - window[1])))
    return violation("a window wide and high enough for finite texels per unit");
  const double near_depth = view.near_depth, far_depth = view.far_depth;
  if (!std::isfinite(near_depth) || !std::isfinite(far_depth) || !(near_depth < far_depth) ||
      !std::isfinite(far_depth * 0x1p32) || !std::isfinite(near_depth * 0x1p32))
    return violation("finite depths, near < far");
  if (view.projection == Projection::perspective && !(near_depth > 0)) return violation("near > 0");
  const double largest = std::max(std::abs(near_depth), std::abs(far_depth));
  if (!(depth_step(view, coding) >= largest * kStepRoundings))
    return violation("near and far further apart, for depth codes to differ");
  // As above: a look-up multiplies a distance of near by the codes per metre.
  if (!std::isfinite(coding.depth_max() / (far_depth - near_depth)))
    return violation("near and far further apart, for finite depth codes per metre");
  if (view.width < 1 || view.width > kMaxViewSize || view.height < 1 || view.height > kMaxViewSize)
    return violation("width and height of 1 to 2^20 texels");
  return {};
}

Verdict check_channels(std::uint32_t channels) {
  if (channels == 1 || channels == 3) return {};
  return Violation{kFaultCoding, "1 or 3 channels"};
}

Verdict check_layers(const PenumbraMap& map) {
  const auto violation = [](const char* expected) { return Violation{kFaultLayer, expected}; };
  if (map.layer_rule != LayerRule::maximum && map.layer_rule != LayerRule::clamped_sum)
    return violation("layer rule 0 or 1");
  if (map.layers.empty()) return violation("one layer or more");
  std::vector<std::string> names = map.layers;
  for (const std::string& name : names) {
    if (name.empty() || name.size() > kMaxLayerName || !is_utf8(name))
      return violation("layer names of 1 to 255 bytes, UTF-8");
  }
  std::sort(names.begin(), names.end());
  if (std::adjacent_find(names.begin(), names.end()) != names.end())
    return violation("layer names that differ");
  return {};
}

Verdict check_images(const PenumbraMap& map) {
  const auto violation = [](const char* expected) { return Violation{kFaultImage, expected}; };
  std::uint64_t base_images = 0;
  for (std::size_t n = 0; n < map.images.size(); ++n) {
    const FunctionImage& image = map.images[n];
    if (image.layer >= map.layers.size() || image.view >= map.views.size() || image.channel >= map.channels ||
        image.level > 31)
      return violation("layer, view, channel and level that exist");
    const auto key = [](const FunctionImage& i) { return std::tuple(i.layer, i.view, i.channel, i.level); };
    if (n > 0 && !(key(map.images[n - 1]) < key(image)))
      return violation("images in order of layer, view, channel, level, each once");
    const View& view = map.views[image.view];
    if (image.width != std::max(1U, view.width >> image.level) ||
        image.height != std::max(1U, view.height >> image.level))
      return violation("images of the view's size, halved for each level");
    const auto below = std::tuple(image.layer, image.view, image.channel, image.level - 1);
    if (image.level > 0 && (n == 0 || key(map.images[n - 1]) != below))
      return violation("levels without a gap");
    base_images += image.level == 0 ? 1 : 0;
  }
  if (base_images != std::uint64_t{map.layers.size()} * map.views.size() * map.channels)
    return violation("a level 0 for each layer, view and channel");
  return {};
}

Verdict check_sample(const LightSample& sample) {
  const auto in_texel = [](float jitter) { return jitter >= -0.5F && jitter < 0.5F; };
  if (all_finite(sample.position) && in_texel(sample.jitter[0]) && in_texel(sample.jitter[1]) &&
      std::isfinite(sample.weight) && sample.weight >= 0)
    return {};
  return Violation{kFaultSample, "finite light samples, jitter in [-0.5, 0.5), weight >= 0"};
}

Verdict check_metadata(const std::string& metadata) {
  if (metadata.size() >= 2 && metadata.front() == '{' && metadata.back() == '}' && is_utf8(metadata))
    return {};
  return Violation{kFaultMetadata, "one JSON object in UTF-8, from { to }"};
}

Verdict check_block(const VertexCoding& coding, std::uint32_t texel_count, const FunctionBlock& block) {
  if (block.first.size() != std::size_t{texel_count} + 1)
    return Violation{kFaultBlockSize, "one function offset for each texel and one behind"};
  const auto& first = block.first;
  if (first.front() != 0 || !std::is_sorted(first.begin(), first.end()))
    return Violation{kFaultFunctionOffsets, "function offsets from 0 that don't decrease"};
  const std::size_t stride = coding.words_per_vertex();
  if (block.words.size() != first.back() * stride)
    return Violation{kFaultBlockSize, "as many vertices as the offsets say"};
  for (std::size_t texel = 0; texel < texel_count; ++texel) {
    const std::uint32_t count = first[texel + 1] - first[texel];
    if (auto verdict = check_function(coding, block.words.data() + first[texel] * stride, count, texel))
      return verdict;
  }
  if (!block.domain_end.empty() && block.domain_end.size() != texel_count)
    return Violation{kFaultBlockSize, "no domain end or one for each texel"};
  for (std::uint32_t end : block.domain_end) {
    if (end > coding.depth_max()) return Violation{kFaultDomainEnd, "domain ends of at most depth_max"};
  }
  return {};
}

Verdict check_block_keys(const PenumbraMap& map) {
  if (map.block_keys.empty()) return {};
  const FunctionImage none, &image = map.images.empty() ? none : map.images.front();
  const std::uint32_t across = image.blocks_across();
  if (map.block_keys.size() != std::uint64_t{across} * image.blocks_up())
    return Violation{kFaultBlockKeys, "one block key for each block of image 0"};
  for (std::uint32_t b = 0; b < map.block_keys.size(); ++b) {
    const auto [width, height] = block_extent(image.width, image.height, b % across, b / across);
    if (map.block_keys[b].undarkened_texels > width * height)
      return Violation{kFaultBlockKeys, "a count of texels that the block has"};
  }
  return {};
}

std::string find_invariant_fault(const PenumbraMap& map) {
  if (auto verdict = check_coding(map.coding)) return "coding: expected " + verdict->expected;
  if (auto verdict = check_channels(map.channels)) return "channels: expected " + verdict->expected;
  if (map.views.empty()) return "views: expected one or more";
  for (std::size_t n = 0; n < map.views.size(); ++n) {
    if (auto verdict = check_view(map.views[n], map.coding))
      return "views[" + std::to_string(n) + "]: expected " + verdict->expected;
  }
  if (auto verdict = check_layers(map)) return "layers: expected " + verdict->expected;
  if (auto verdict = check_images(map)) return "images: expected " + verdict->expected;
  for (std::size_t n = 0; n < map.samples.size(); ++n) {
    if (auto verdict = check_sample(map.samples[n]))
      return "samples[" + std::to_string(n) + "]: expected " + verdict->expected;
  }
  if (auto verdict = check_metadata(map.metadata)) return "metadata: expected " + verdict->expected;
  if (auto verdict = check_block_keys(map)) return "block_keys: expected " + verdict->expected;
  for (std::size_t n = 0; n < map.images.size(); ++n) {
    const FunctionImage& image = map.images[n];
    const std::string where = "images[" + std::to_string(n) + "].blocks";
    const std::uint64_t block_count = std::uint64_t{image.blocks_across()} * image.blocks_up();
    if (image.blocks.size() != block_count) return where + ": expected one for each 64 x 64 texels";
    for (std::uint32_t b = 0; b < block_count; ++b) {
      const auto [width, height] =
          block_extent(image.width, image.height, b % image.blocks_across(), b / image.blocks_across());
      if (auto verdict = check_block(map.coding, width * height, image.blocks[b]))
        return where + "[" + std::to_string(b) + "]: expected " + verdict->expected;
    }
  }
  return {};
}

}  // namespace pdsm
