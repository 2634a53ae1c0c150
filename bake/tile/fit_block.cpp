// SPDX-License-Identifier: Apache-2.0
#include "tile/fit_block.h"

#include <omp.h>

#include <algorithm>
#include <cmath>

#include "events/merge_quads.h"

namespace pdsm {
namespace {

/// Depth code of a domain end, rounded up.
std::uint32_t end_code(const FitRules& rules, float end) {
  const double code = std::ceil(rules.code_of(end)), max = rules.coding.depth_max();
  return static_cast<std::uint32_t>(std::clamp(code, 0.0, max));
}

void append_function(const VertexCoding& coding, const std::vector<FunctionVertex>& vertices,
                     FunctionBlock& block) {
  const std::size_t words = coding.words_per_vertex();
  for (const FunctionVertex& vertex : vertices) {
    block.words.resize(block.words.size() + words);
    pack_vertex(coding, vertex, block.words.data() + block.words.size() - words);
  }
  block.first.push_back(static_cast<std::uint32_t>(block.words.size() / words));
}

/// Greatest domain end of each 2 x 2 texels of `ends`, width x height; none of none.
std::vector<std::uint32_t> join_ends(const std::vector<std::uint32_t>& ends, std::uint32_t width,
                                     std::uint32_t height) {
  std::vector<std::uint32_t> joined;
  if (ends.empty()) return joined;
  for (std::uint32_t j = 0; j < height / 2; ++j) {
    for (std::uint32_t i = 0; i < width / 2; ++i) {
      const std::size_t lower = std::size_t{2} * j * width + 2 * i, upper = lower + width;
      joined.push_back(std::max({ends[lower], ends[lower + 1], ends[upper], ends[upper + 1]}));
    }
  }
  return joined;
}

/// Fits one block and its levels; holds what the steps share.
class BlockFit {
 public:
  BlockFit(const TileInput& input, const TileBlock& block, FitThread& thread)
      : input_(input), block_(block), thread_(thread) {}

  FittedBlock run(std::span<const EventLog* const> logs) {
    const double start = omp_get_wtime();
    FittedBlock fitted;
    fitted.index = block_.index;
    fitted.inputs = block_.inputs;
    fitted.width = static_cast<std::uint32_t>(block_.rect.x1 - block_.rect.x0);
    fitted.height = static_cast<std::uint32_t>(block_.rect.y1 - block_.rect.y0);
    gather_events(logs, fitted.width * fitted.height, thread_.events);
    accumulated_ = omp_get_wtime() - start;
    fitted.counts.events = thread_.events.keys.size();
    fitted.levels.push_back(fit_base(fitted.counts));
    while (fitted.levels.size() <= input_.level_rules.size()) fitted.levels.push_back(fit_next(fitted));
    thread_.statistics.accumulate += accumulated_;
    thread_.statistics.fit += omp_get_wtime() - start - accumulated_;
    return fitted;
  }

 private:
  FunctionBlock fit_base(BlockCounts& counts) {
    FunctionBlock functions = fit_texels(0);
    if (input_.receivers != Receivers::all) {
      for (const float end : block_.domain_ends) functions.domain_end.push_back(end_code(input_.rules, end));
    }
    counts.pieces = functions.first.back();
    for (std::size_t t = 1; t < functions.first.size(); ++t)
      counts.empty_texels += functions.first[t] == functions.first[t - 1] ? 1 : 0;
    return functions;
  }

  /// The level above the last of `fitted`, whose events are at hand, sorted.
  FunctionBlock fit_next(const FittedBlock& fitted) {
    const std::size_t level = fitted.levels.size();
    const std::uint32_t width = fitted.width >> (level - 1), height = fitted.height >> (level - 1);
    const double start = omp_get_wtime();
    merge_quads(thread_.events, width, height, thread_.next_events, thread_.merge_room);
    std::swap(thread_.events, thread_.next_events);
    accumulated_ += omp_get_wtime() - start;
    FunctionBlock functions = fit_texels(level);
    functions.domain_end = join_ends(fitted.levels.back().domain_end, width, height);
    return functions;
  }

  /// The functions of all texels that have their events gathered.
  FunctionBlock fit_texels(std::size_t level) {
    const FitRules& rules = level == 0 ? input_.rules : input_.level_rules[level - 1];
    const std::size_t texels = thread_.events.first.size() - 1;
    FunctionBlock functions;
    functions.first.reserve(texels + 1);
    functions.first.push_back(0);
    for (std::size_t t = 0; t < texels; ++t) {
      const std::size_t first = thread_.events.first[t], last = thread_.events.first[t + 1];
      thread_.vertices.clear();
      if (first != last) {
        sum_up(level, std::span(thread_.events.keys).subspan(first, last - first));
        // A filtered look-up asks texels up to 2^level beside the surface that it is for, whose bands are not
        // those of the texel's own rays: levels keep the tube at all depths.
        const bool has_bands = level == 0 && !block_.bands.empty();
        fit_function(thread_.function, rules, thread_.room, thread_.vertices,
                     has_bands ? &block_.bands[t] : nullptr);
      }
      append_function(rules.coding, thread_.vertices, functions);
    }
    return functions;
  }

  void sum_up(std::size_t level, std::span<EventKey> keys) {
    const double before = omp_get_wtime();
    if (level == 0)
      accumulate(keys, thread_.function, thread_.merge_room);
    else
      sum_events(keys, thread_.function);
    accumulated_ += omp_get_wtime() - before;
  }

  const TileInput& input_;
  const TileBlock& block_;
  FitThread& thread_;
  double accumulated_ = 0;  ///< seconds
};

}  // namespace

FittedBlock fit_block(const TileInput& input, const TileBlock& block, std::span<const EventLog* const> logs,
                      FitThread& thread) {
  return BlockFit(input, block, thread).run(logs);
}

}  // namespace pdsm
