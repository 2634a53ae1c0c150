// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "file_bytes.h"
#include "pdsm/format/map_file.h"

/// A file to break, and what has to be said of it.
namespace pdsm::testing {

/// Two blocks, vertices in each texel, domain ends, all chunks.
[[nodiscard]] PenumbraMap sample_map();
[[nodiscard]] Bytes sample_file(Compression compression = Compression::none);

/// Offset of the payload of the first chunk of a type, plus `inside`.
[[nodiscard]] std::size_t payload_at(const Bytes& file, const std::string& type, std::size_t inside = 0);

/// Repairs the checksums (unless told not to) and expects this fault first, from reader and checker.
void expect_fault(Bytes file, int number, std::uint64_t offset, bool repair = true);

}  // namespace pdsm::testing
