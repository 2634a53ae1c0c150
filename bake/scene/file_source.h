// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace pdsm {

/// Reads the files of a scene and keeps a hash of all of their bytes, each file once, in the order in which
/// they were first asked for. Not for several threads.
class FileSource {
 public:
  FileSource();
  ~FileSource();
  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;

  /// The bytes of a regular file. Throws Error (input) "path: reason" for one that is missing, unreadable,
  /// a directory, FIFO or device (which are never opened), or larger than `limit`.
  [[nodiscard]] std::string read(const std::filesystem::path& path, std::uint64_t limit = kNoLimit);

  /// The same, with the content of a file whose name ends in .gz unpacked. The hash is of the packed bytes.
  [[nodiscard]] std::string read_unpacked(const std::filesystem::path& path);

  /// XXH3-64 over everything read so far.
  [[nodiscard]] std::uint64_t content_hash() const;

  /// What was read, each file once, in order.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

  static constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};

 private:
  struct Hash;
  std::unique_ptr<Hash> hash_;
  std::set<std::filesystem::path> hashed_;
  std::vector<std::filesystem::path> files_;
};

/// Unpacks gzip data, at most `limit` bytes. Throws Error (input) "name: reason".
[[nodiscard]] std::string gunzip(const std::string& packed, const std::string& name, std::uint64_t limit);

/// Whether the name ends in `extension` (lower case, with its dot), in whatever case.
[[nodiscard]] bool has_extension(const std::filesystem::path& path, const std::string& extension);

}  // namespace pdsm
