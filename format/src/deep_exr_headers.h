// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace pdsm {

struct ExrHeaderFault {
  std::string field, reason;
};

/// What is wrong with the headers of an OpenEXR file; empty for headers that OpenEXR can be given. It
/// allocates what an attribute claims to take before it reads it, and reads a value of known type by that
/// type, whatever size is stated: from there on it would take other bytes for sizes than a check by stated
/// sizes has seen. So each attribute has to lie in the file and take what its type takes.
[[nodiscard]] std::optional<ExrHeaderFault> find_exr_header_fault(std::span<const std::byte> bytes);

/// zlib can't make more than this of a byte; claims beyond are lies.
inline constexpr std::uint64_t kMaxExpansion = 1032;

}  // namespace pdsm
