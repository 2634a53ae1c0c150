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

/// Events where all casters are opaque.
struct OpaqueEvents {
  FitThread& thread;

  [[nodiscard]] const BlockEvents& block() const { return thread.events; }
  void gather(std::span<const EventLog* const> logs, std::uint32_t texels) const {
    gather_events(logs, texels, thread.events);
  }
  void next_level(std::uint32_t width, std::uint32_t height) const {
    merge_quads(thread.events, width, height, thread.next_events, thread.merge_room);
    std::swap(thread.events, thread.next_events);
  }
  void sum_up(std::size_t level, std::size_t first, std::size_t count) const {
    const auto keys = std::span(thread.events.keys).subspan(first, count);
    if (level == 0)
      accumulate(keys, thread.function, thread.merge_room);
    else
      sum_events(keys, thread.function);
  }
};

/// Events where some are translucent.
struct TranslucentEvents {
  FitThread& thread;
  std::uint32_t unit;

  [[nodiscard]] const BlockChanges& block() const { return thread.changes; }
  void gather(std::span<const EventLog* const> logs, std::uint32_t texels) const {
    gather_changes(logs, texels, thread.changes);
  }
  void next_level(std::uint32_t width, std::uint32_t height) const {
    join_quads(thread.changes, width, height, thread.next_changes);
    std::swap(thread.changes, thread.next_changes);
  }
  void sum_up(std::size_t level, std::size_t first, std::size_t count) const {
    sum_changes(std::span(thread.changes.keys).subspan(first, count), unit, static_cast<std::uint32_t>(level),
                thread.function);
  }
};

/// Fits one block and its levels; holds what the steps share.
template <typename Events>
class BlockFit {
 public:
  BlockFit(const TileInput& input, const TileBlock& block, FitThread& thread, Events events)
      : input_(input), block_(block), thread_(thread), events_(events) {}

  FittedBlock run(std::span<const EventLog* const> logs) {
    const double start = omp_get_wtime();
    FittedBlock fitted;
    fitted.index = block_.index;
    fitted.inputs = block_.inputs;
    fitted.width = static_cast<std::uint32_t>(block_.rect.x1 - block_.rect.x0);
    fitted.height = static_cast<std::uint32_t>(block_.rect.y1 - block_.rect.y0);
    events_.gather(logs, fitted.width * fitted.height);
    accumulated_ = omp_get_wtime() - start;
    fitted.counts.events = events_.block().keys.size();
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
    events_.next_level(width, height);
    accumulated_ += omp_get_wtime() - start;
    FunctionBlock functions = fit_texels(level);
    functions.domain_end = join_ends(fitted.levels.back().domain_end, width, height);
    return functions;
  }

  /// The functions of all texels that have their events gathered.
  FunctionBlock fit_texels(std::size_t level) {
    const FitRules& rules = level == 0 ? input_.rules : input_.level_rules[level - 1];
    const std::vector<std::uint32_t>& firsts = events_.block().first;
    const std::size_t texels = firsts.size() - 1;
    FunctionBlock functions;
    functions.first.reserve(texels + 1);
    functions.first.push_back(0);
    for (std::size_t t = 0; t < texels; ++t) {
      const std::size_t first = firsts[t], last = firsts[t + 1];
      thread_.vertices.clear();
      if (first != last) {
        sum_up(level, first, last - first);
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

  void sum_up(std::size_t level, std::size_t first, std::size_t count) {
    const double before = omp_get_wtime();
    events_.sum_up(level, first, count);
    accumulated_ += omp_get_wtime() - before;
  }

  const TileInput& input_;
  const TileBlock& block_;
  FitThread& thread_;
  const Events events_;
  double accumulated_ = 0;  ///< seconds
};

}  // namespace

FittedBlock fit_block(const TileInput& input, const TileBlock& block, std::span<const EventLog* const> logs,
                      FitThread& thread) {
  if (input.is_translucent())
    return BlockFit(input, block, thread, TranslucentEvents{thread, input.rules.transmittance_unit})
        .run(logs);
  return BlockFit(input, block, thread, OpaqueEvents{thread}).run(logs);
}

}  // namespace pdsm
