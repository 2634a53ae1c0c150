// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace pdsm {

/// An output file that appears under its name whole or not at all: written to a temporary in the same
/// folder, synced and renamed by commit(), removed by the destructor otherwise. Temporaries of live
/// writers are also removed by remove_temporaries(), for signal handlers. One thread at a time.
/// Every failure throws Error (resource) that names `path` and the system's reason.
class AtomicFile {
 public:
  /// Creates the temporary; fails at once where the folder can't be written or `path` is a folder.
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes);
  /// Makes the file appear: fsync, rename, fsync of the folder.
  void commit();
  /// Where to write when a library insists on opening the file itself.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  /// Async-signal-safe: unlinks the temporaries of all live AtomicFiles.
  static void remove_temporaries() noexcept;

 private:
  std::filesystem::path path_, temporary_;
  int descriptor_ = -1;
  int slot_ = -1;
};

}  // namespace pdsm
