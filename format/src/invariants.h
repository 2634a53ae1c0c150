// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pdsm/format/penumbra_map.h"

/// The invariants of penumbra_map.h, part by part: what the reader checks after decoding and the writer
/// before encoding.
namespace pdsm {

/// A broken invariant: the fault number of FORMAT.md section 8 and what should hold.
struct Violation {
  int number = 0;
  std::string expected;
};
using Verdict = std::optional<Violation>;  ///< empty: all holds

/// Texels along a side of a view, at most; keeps block indices within 32 bits.
inline constexpr std::uint32_t kMaxViewSize = 1U << 20;
/// Bytes of a layer's name, at most.
inline constexpr std::size_t kMaxLayerName = 255;

[[nodiscard]] Verdict check_coding(const VertexCoding& coding);
[[nodiscard]] Verdict check_view(const View& view, const VertexCoding& coding);
/// Names and rule of the layers.
[[nodiscard]] Verdict check_channels(std::uint32_t channels);
[[nodiscard]] Verdict check_layers(const PenumbraMap& map);
/// Order, completeness and sizes of the images, not their blocks.
[[nodiscard]] Verdict check_images(const PenumbraMap& map);
[[nodiscard]] Verdict check_sample(const LightSample& sample);
[[nodiscard]] Verdict check_metadata(const std::string& metadata);
/// One for each block of image 0, or none.
[[nodiscard]] Verdict check_block_keys(const PenumbraMap& map);
/// A block of `texel_count` texels.
[[nodiscard]] Verdict check_block(const VertexCoding& coding, std::uint32_t texel_count,
                                  const FunctionBlock& block);

}  // namespace pdsm
