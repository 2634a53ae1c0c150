// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace pdsm {

/// A file that one process appends to, under a lock that ends with the process. Failures throw Error
/// (resource) "path: reason". One thread at a time.
class PartFile {
 public:
  enum class Open { existing, existing_or_new };
  /// Opens and locks a regular file; nothing where there is none to open, under Open::existing. Fails where
  /// another process has the lock.
  [[nodiscard]] static std::optional<PartFile> open(const std::filesystem::path& path, Open how);

  PartFile(PartFile&& other) noexcept;
  PartFile& operator=(PartFile&& other) noexcept;
  ~PartFile();

  /// Cuts the file to `size` bytes.
  void cut(std::uint64_t size);
  void append(std::span<const std::byte> bytes);
  void remove();

 private:
  PartFile(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace pdsm
