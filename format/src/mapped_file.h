// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace pdsm {

/// A whole file mapped read-only: pages are read when they are looked at, and none is copied. Writers of
/// pdsm replace files and never cut them, so that what is mapped stays.
class MappedFile {
 public:
  /// Throws Error (input) where `path` is no regular file or can't be read.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  [[nodiscard]] std::span<const std::byte> bytes() const {
    return {static_cast<const std::byte*>(data_), size_};
  }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace pdsm
