// SPDX-License-Identifier: Apache-2.0
#include "evaluate/map_diff.h"

#include <algorithm>
#include <cmath>

namespace pdsm {
namespace {

/// A vertex in metres and attenuation.
struct Knot {
  double depth, begin, end;
};

/// One function of a map, decoded and walked along with increasing depth.
class FunctionWalk {
 public:
  FunctionWalk(const PenumbraMap& map, const FunctionImage& image, std::size_t block, std::uint32_t texel) {
    const View& view = map.views[image.view];
    const double top = map.coding.value_max;
    for (const FunctionVertex& v : unpack_function(map.coding, image.blocks[block], texel)) {
      knots_.push_back({decode_depth(view, map.coding, v.depth), v.begin / top, v.end / top});
    }
  }

  /// Depth of the next vertex; infinite after the last.
  [[nodiscard]] double next() const { return passed_ < knots_.size() ? knots_[passed_].depth : INFINITY; }
  void pass_until(double depth) {
    while (next() <= depth) ++passed_;
  }
  /// V at `depth`, from the piece that the walk is in.
  [[nodiscard]] double value(double depth) const {
    if (passed_ == 0) return 0;
    const Knot& from = knots_[passed_ - 1];
    if (passed_ == knots_.size()) return from.begin;
    const double t = (depth - from.depth) / (knots_[passed_].depth - from.depth);
    return from.begin + (from.end - from.begin) * t;
  }

 private:
  std::vector<Knot> knots_;
  std::size_t passed_ = 0;
};

struct FunctionDifference {
  double max = 0, integral = 0, depth = 0;

  void see(double difference, double at) {
    if (std::abs(difference) <= max) return;
    max = std::abs(difference);
    depth = at;
  }
};

/// Integral of |d| for d linear from d0 to d1 over `length`.
double absolute_integral(double d0, double d1, double length) {
  const double sum = std::abs(d0) + std::abs(d1);
  if (d0 * d1 >= 0) return 0.5 * sum * length;
  return 0.5 * (d0 * d0 + d1 * d1) / sum * length;
}

/// Walks both functions from vertex to vertex up to `far_depth`.
FunctionDifference compare_functions(FunctionWalk a, FunctionWalk b, double far_depth) {
  FunctionDifference result;
  double depth = std::min(a.next(), b.next());
  while (std::isfinite(depth)) {
    // The jump at a vertex: its left side was seen as the end of the piece before.
    a.pass_until(depth);
    b.pass_until(depth);
    const double after = a.value(depth) - b.value(depth);
    result.see(after, depth);

    const double next = std::min(a.next(), b.next());
    const double end = std::isfinite(next) ? next : std::max(far_depth, depth);
    const double before_next = a.value(end) - b.value(end);
    result.see(before_next, end);
    result.integral += absolute_integral(after, before_next, end - depth);
    depth = next;
  }
  return result;
}

bool same_frame(const View& a, const View& b) {
  return a.world_to_view.rotation == b.world_to_view.rotation &&
         a.world_to_view.translation == b.world_to_view.translation && a.projection == b.projection;
}

/// What keeps two maps from being compared; empty when nothing does.
std::string find_obstacle(const PenumbraMap& a, const PenumbraMap& b) {
  if (a.views.size() != b.views.size()) return "numbers of views differ";
  if (a.images.size() != b.images.size()) return "numbers of images (layers, views, mip levels) differ";
  for (std::size_t v = 0; v < a.views.size(); ++v) {
    if (a.views[v].width != b.views[v].width || a.views[v].height != b.views[v].height) return "sizes differ";
    if (!same_frame(a.views[v], b.views[v])) return "frames of the views differ";
    if (a.views[v].window != b.views[v].window) return "windows differ";
  }
  for (std::size_t n = 0; n < a.images.size(); ++n) {
    const FunctionImage &x = a.images[n], &y = b.images[n];
    if (x.layer != y.layer || x.view != y.view || x.level != y.level)
      return "images differ in what they show";
  }
  return {};
}

/// Compares block by block and gathers; sums go in a fixed order.
class Comparison {
 public:
  Comparison(const PenumbraMap& a, const PenumbraMap& b, MapDifference& result)
      : a_(a), b_(b), result_(result) {}

  void add_image(std::uint32_t n) {
    const FunctionImage& image = a_.images[n];
    for (std::uint32_t by = 0; by < image.blocks_up(); ++by) {
      for (std::uint32_t bx = 0; bx < image.blocks_across(); ++bx) add_block(n, bx, by);
    }
  }

  [[nodiscard]] double sum() const { return sum_; }

 private:
  void add_block(std::uint32_t n, std::uint32_t bx, std::uint32_t by) {
    const FunctionImage& image = a_.images[n];
    const std::size_t block = std::size_t{by} * image.blocks_across() + bx;
    const auto [width, height] = block_extent(image.width, image.height, bx, by);
    for (std::uint32_t texel = 0; texel < width * height; ++texel) {
      const std::uint32_t i = bx * kBlockSize + texel % width, j = by * kBlockSize + texel / width;
      add_texel(n, block, texel, i, j);
      add_domain(image.blocks[block], b_.images[n].blocks[block], texel);
    }
  }

  void add_texel(std::uint32_t n, std::size_t block, std::uint32_t texel, std::uint32_t i, std::uint32_t j) {
    const View &va = a_.views[a_.images[n].view], &vb = b_.views[b_.images[n].view];
    const double far_depth = std::max(va.far_depth, vb.far_depth);
    const double range = far_depth - std::min(va.near_depth, vb.near_depth);
    const FunctionDifference found =
        compare_functions(FunctionWalk(a_, a_.images[n], block, texel),
                          FunctionWalk(b_, b_.images[n], block, texel), far_depth);
    ++result_.texels;
    sum_ += found.integral / range;
    result_.differing_texels += found.max > 0 ? 1 : 0;
    if (n == 0) result_.texel_max[std::size_t{j} * result_.width + i] = static_cast<float>(found.max);
    if (found.max <= result_.max_difference) return;
    result_.max_difference = found.max;
    result_.worst_i = i;
    result_.worst_j = j;
    result_.worst_image = n;
    result_.worst_level = a_.images[n].level;
    result_.worst_depth = found.depth;
  }

  void add_domain(const FunctionBlock& a, const FunctionBlock& b, std::uint32_t texel) {
    const auto end = [texel](const FunctionBlock& block, const VertexCoding& coding) {
      return block.domain_end.empty() ? coding.depth_max() : block.domain_end[texel];
    };
    result_.differing_domains += end(a, a_.coding) != end(b, b_.coding) ? 1 : 0;
  }

  const PenumbraMap &a_, &b_;
  MapDifference& result_;
  double sum_ = 0;
};

}  // namespace

MapDifference compare_maps(const PenumbraMap& a, const PenumbraMap& b) {
  MapDifference result;
  result.incomparable = find_obstacle(a, b);
  if (!result.incomparable.empty()) return result;
  result.width = a.images.front().width;
  result.height = a.images.front().height;
  result.texel_max.resize(std::size_t{result.width} * result.height);
  Comparison comparison(a, b, result);
  for (std::uint32_t n = 0; n < a.images.size(); ++n) comparison.add_image(n);
  result.mean_difference = comparison.sum() / static_cast<double>(result.texels);
  return result;
}

}  // namespace pdsm
