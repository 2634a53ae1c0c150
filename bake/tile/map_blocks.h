// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "pdsm/format/map_file.h"
#include "tile/tile_block.h"

namespace pdsm {

/// Puts the images of a map together, level by level, from the blocks of level 0 in any order. A block of
/// level l lies over up to 2^l x 2^l of them: their parts of it wait until all are there, and it is encoded.
/// What comes out depends on the functions alone.
class MapBlocks {
 public:
  /// Takes an encoded block of a level. Called from the threads that call take().
  using Finished = std::function<void(std::uint32_t level, std::uint32_t block, EncodedBlock&& encoded)>;

  /// For levels 0, 1, ... of one view; only the sizes of `images` are looked at. Whole blocks go to
  /// `finished`; without it, they are kept.
  MapBlocks(const VertexCoding& coding, std::span<const FunctionImage> images, Finished finished = {});

  /// Takes a block with its part of each level, each block once. Any thread, several at once.
  void take(FittedBlock&& block);
  /// The same where level 0 is encoded already.
  void take(FittedBlock&& block, EncodedBlock&& base);

  /// The encoded blocks of each image that were kept, row by row, once all have been taken. Empties this.
  [[nodiscard]] std::vector<std::vector<EncodedBlock>> release() { return std::move(encoded_); }

 private:
  /// A block of a level while its parts come in.
  struct OpenBlock {
    std::uint32_t parts_across = 0, missing = 0;
    std::vector<FunctionBlock> parts;  ///< row by row
  };
  struct Level {
    std::uint32_t width = 0, height = 0;  ///< texels
    std::uint32_t across = 0;             ///< blocks
    std::vector<OpenBlock> open;
  };

  void open_level(const FunctionImage& image);
  void finish(std::uint32_t level, std::uint32_t block, EncodedBlock&& encoded);
  void take_level_part(std::uint32_t level, std::uint32_t bx, std::uint32_t by, FunctionBlock&& part);

  VertexCoding coding_;
  Finished finished_;
  std::vector<Level> levels_;
  std::vector<std::vector<EncodedBlock>> encoded_;
  std::mutex mutex_;  ///< of the open blocks
};

}  // namespace pdsm
