// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

/// zstd behind two small classes; the only file that knows the library is zstd_stream.cpp.
namespace pdsm {

/// One zstd frame of several parts, each with entropy tables of its own.
/// The bytes depend on the parts and the zstd version alone. Throws Error (resource) out of memory.
[[nodiscard]] std::vector<std::byte> compress_parts(std::span<const std::vector<std::byte>> parts);

/// Decompresses one frame piece by piece. Safe on any bytes: memory stays within a fixed window.
class ZstdReader {
 public:
  explicit ZstdReader(std::span<const std::byte> stored);
  ~ZstdReader();

  /// Fills `bytes`; false where the frame is broken or ends before.
  [[nodiscard]] bool read(std::span<std::byte> bytes);
  /// Appends `count` bytes, growing `bytes` only as fast as they turn out to be there.
  [[nodiscard]] bool append(std::vector<std::byte>& bytes, std::uint64_t count);
  /// Whether the frame ends here and nothing is stored behind it.
  [[nodiscard]] bool at_end();

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace pdsm
