// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "invariants.h"
#include "pdsm/format/penumbra_map.h"

/// Payloads of BLCK chunks. FORMAT.md section 6.
namespace pdsm {

/// Bytes of the raw form of a block; UINT64_MAX where they don't fit 64 bits.
[[nodiscard]] std::uint64_t raw_block_size(const VertexCoding& coding, std::uint64_t texel_count,
                                           std::uint64_t vertex_count, bool has_domain_end);

/// Decodes and checks one block from bytes of any origin. Empty: `block` is good.
[[nodiscard]] Verdict decode_block(const VertexCoding& coding, std::uint32_t width, std::uint32_t height,
                                   std::uint32_t encoding, std::span<const std::byte> stored,
                                   std::uint64_t decoded_size, FunctionBlock& block);

}  // namespace pdsm
