// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "evaluate/texel_quad.h"
#include "pdsm/format/penumbra_map.h"

namespace pdsm {

/// What the four functions of a quad say at its depth, and where their domains end (metres).
struct QuadFunctions {
  std::array<double, 4> attenuation{}, domain_end{};
};

/// Asks the functions of a map for many quads, a block at a time, so that a map need never be whole in
/// memory.
class QuadAnswers {
 public:
  /// Borrows `quads`, of the view's points, which must outlive it.
  QuadAnswers(const View& view, const VertexCoding& coding, std::span<const TexelQuad> quads);

  /// Answers all that is asked of block `index` of level 0. Each block from any thread, several at once.
  void see(std::uint32_t index, const FunctionBlock& block);

  /// By quad; complete once all blocks were seen.
  [[nodiscard]] const std::vector<QuadFunctions>& functions() const { return functions_; }
  /// Bilinear look-ups by these, rounded to float as those of PenumbraLookUp are.
  [[nodiscard]] std::vector<double> mixed() const;

 private:
  /// One corner of one quad.
  struct Question {
    std::size_t quad;
    std::uint32_t corner, texel;  ///< texel: index in the block
  };

  View view_;
  VertexCoding coding_;
  std::span<const TexelQuad> quads_;
  std::vector<std::vector<Question>> questions_;  ///< by block
  std::vector<QuadFunctions> functions_;
};

}  // namespace pdsm
