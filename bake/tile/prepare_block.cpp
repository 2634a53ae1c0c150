// SPDX-License-Identifier: Apache-2.0
#include "tile/prepare_block.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tile/block_inputs.h"
#include "trace/domain_ends.h"
#include "trace/surface_bands.h"

namespace pdsm {
namespace {

/// Depth code of a band's border, rounded to the code below.
std::int64_t band_code(const FitRules& rules, float depth) {
  return static_cast<std::int64_t>(
      std::clamp(std::floor(rules.code_of(depth)), 0.0, static_cast<double>(rules.coding.depth_max())));
}

std::vector<std::vector<CodeBand>> find_code_bands(const TileInput& input, const TexelRect& rect) {
  // Within delta and the bias of a surface, its own shadow begins.
  const double margin = input.bias.constant + input.rules.tolerance;
  std::vector<std::vector<CodeBand>> result;
  for (const auto& bands : find_surface_bands(input.scene, input.grid, rect, margin)) {
    auto& codes = result.emplace_back();
    for (const DepthBand& band : bands) {
      const std::int64_t last_code = input.rules.coding.depth_max();
      const CodeBand code{band_code(input.rules, band.first),
                          std::min(band_code(input.rules, band.last) + 1, last_code)};
      if (code.first >= code.last) continue;
      if (!codes.empty() && code.first <= codes.back().last)
        codes.back().last = std::max(codes.back().last, code.last);
      else
        codes.push_back(code);
    }
  }
  return result;
}

}  // namespace

void prepare_block(const TileInput& input, TileBlock& block) {
  block.domain_ends.assign(block.rect.area(), std::numeric_limits<float>::infinity());
  if (input.receivers != Receivers::all)
    find_domain_ends(input.scene, input.grid, block.rect, block.domain_ends);
  if (input.receivers == Receivers::surfaces) block.bands = find_code_bands(input, block.rect);
  if (input.block_inputs != nullptr) block.inputs = input.block_inputs->key(block);
}

}  // namespace pdsm
