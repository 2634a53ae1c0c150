// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pdsm/format/penumbra_map.h"

/// The compressed form of a block: prediction residuals as byte planes, then zstd. FORMAT.md section 6.2.
namespace pdsm {

/// Compresses a valid block `width` texels wide.
[[nodiscard]] std::vector<std::byte> compress_block(const VertexCoding& coding, std::uint32_t width,
                                                    const FunctionBlock& block);

/// Inverse of compress_block. Safe on any bytes: false where they are not what it writes; true does not
/// mean that the block's invariants hold. Refuses blocks whose raw form is not `raw_size` bytes before it
/// allocates them.
[[nodiscard]] bool decompress_block(const VertexCoding& coding, std::uint32_t width, std::uint32_t height,
                                    std::span<const std::byte> stored, std::uint64_t raw_size,
                                    FunctionBlock& block);

}  // namespace pdsm
