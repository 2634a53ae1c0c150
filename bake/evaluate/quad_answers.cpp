// SPDX-License-Identifier: Apache-2.0
#include "evaluate/quad_answers.h"

namespace pdsm {

QuadAnswers::QuadAnswers(const View& view, const VertexCoding& coding, std::span<const TexelQuad> quads)
    : view_(view), coding_(coding), quads_(quads), functions_(quads.size()) {
  FunctionImage image;
  image.width = view.width;
  image.height = view.height;
  questions_.resize(std::size_t{image.blocks_across()} * image.blocks_up());
  for (std::size_t n = 0; n < quads.size(); ++n) {
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      const auto [i, j] = quads[n].texel[corner];
      const std::uint32_t bx = i / kBlockSize, by = j / kBlockSize;
      const std::uint32_t width = block_extent(view.width, view.height, bx, by)[0];
      const std::uint32_t texel = j % kBlockSize * width + i % kBlockSize;
      questions_[std::size_t{by} * image.blocks_across() + bx].push_back({n, corner, texel});
    }
  }
}

void QuadAnswers::see(std::uint32_t index, const FunctionBlock& block) {
  for (const Question& question : questions_[index]) {
    const auto function = unpack_function(coding_, block, question.texel);
    QuadFunctions& answer = functions_[question.quad];
    answer.attenuation[question.corner] =
        evaluate_function(view_, coding_, function, quads_[question.quad].depth);
    answer.domain_end[question.corner] = block.domain_end.empty()
                                             ? view_.far_depth
                                             : decode_depth(view_, coding_, block.domain_end[question.texel]);
  }
}

std::vector<double> QuadAnswers::mixed() const {
  std::vector<double> mixed(quads_.size());
  for (std::size_t n = 0; n < mixed.size(); ++n)
    mixed[n] = static_cast<double>(static_cast<float>(quads_[n].mix(functions_[n].attenuation)));
  return mixed;
}

}  // namespace pdsm
