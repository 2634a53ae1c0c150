// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "pdsm/format/map_file.h"

namespace pdsm {

/// The blocks of a map file one by one, as far as they are sound: for who can do without those that are not.
/// Any number of threads may read. The file stays mapped: it may be replaced or removed meanwhile, but must
/// not be cut.
class BlockReader {
 public:
  /// Nothing where there is no such file, or its header, table or MAPD chunk don't hold. Safe on any bytes.
  [[nodiscard]] static std::optional<BlockReader> open(const std::filesystem::path& path,
                                                       const ReadLimits& limits = {});
  BlockReader(BlockReader&&) noexcept;
  BlockReader& operator=(BlockReader&&) noexcept;
  ~BlockReader();

  /// The map without blocks, light samples and metadata; without block keys where these don't hold.
  [[nodiscard]] const PenumbraMap& frame() const;

  /// Block `block` of image `image` of the frame; nothing where it is damaged, or the blocks before it take
  /// all that the limits allow.
  [[nodiscard]] std::optional<FunctionBlock> read(std::uint32_t image, std::uint32_t block) const;

 private:
  struct File;
  explicit BlockReader(std::unique_ptr<File> file);
  std::unique_ptr<File> file_;
};

}  // namespace pdsm
