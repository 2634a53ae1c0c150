// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "pdsm/bake/bake.h"

/// Bakes whose blocks are handed over as they finish, for hosts that write containers of their own.
namespace pdsm {

/// Who takes a map while it is baked.
struct BakeStream {
  /// Called once, before the first block, from the thread that called: the map without its blocks and
  /// metadata (views, coding, light samples; sizes of all images) and the fitted view; counts are 0. May be
  /// empty.
  std::function<void(const BakedMap& frame)> begin;
  /// Takes block `block` of image `image`, encoded as write_encoded_map() takes it and decode_block() reads
  /// it. Called once a block, in any order and from several threads at once; what it throws ends the bake.
  /// The bytes of each block are the same on every run.
  std::function<void(std::uint32_t image, std::uint32_t block, EncodedBlock&& encoded)> take;
};

/// The same as bake(), but that finished blocks go to `stream` and are not kept: `blocks` of the result are
/// empty; its block keys are not. Blocks of a checkpoint come again, so that a stream is always whole.
[[nodiscard]] BakedMap bake_streamed(const Scene& scene, const Light& light, const BakeOptions& options,
                                     const BakeStream& stream, const BakeCallbacks& callbacks = {},
                                     Checkpoint* checkpoint = nullptr);

}  // namespace pdsm
