// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace pdsm {

/// What changes when a file is written or replaced.
struct FileSignature {
  std::int64_t seconds = 0, nanoseconds = 0;  ///< of the last modification
  std::uint64_t size = 0, device = 0, inode = 0;

  friend bool operator==(const FileSignature&, const FileSignature&) = default;
};

/// Nothing when there is no such file.
[[nodiscard]] std::optional<FileSignature> file_signature(const std::filesystem::path& path);

}  // namespace pdsm
