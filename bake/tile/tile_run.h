// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "pdsm/bake/bake.h"
#include "tile/bake_job.h"
#include "tile/bake_tile.h"

namespace pdsm {

/// Who is told while tiles are baked.
struct TileRunOutput {
  BlockSink take;                                             ///< each block once, from several threads
  BakeCallbacks callbacks;                                    ///< of the bake
  std::function<void(const TileStatistics&)> tile_done = {};  ///< from one thread; may be empty
  std::function<void()> idle = {};                            ///< now and then, from one thread; may be empty
};

/// Bakes the tiles of a job's plan, halving those whose events take too much room.
class TileRun {
 public:
  /// `job` and `input` must outlive it.
  TileRun(const BakeJob& job, const TileInput& input, TileRunOutput output);

  /// Leaves out a block that is there already. Before run(), once a block.
  void leave_out(std::uint32_t block, const BlockCounts& counts);

  [[nodiscard]] bool is_left_out(std::uint32_t block) const { return is_left_out_[block]; }

  /// Bakes all other blocks of the plan. Throws Error (resource) when the memory can't be met, (interrupted).
  void run();

  /// What the tiles took.
  [[nodiscard]] const TileStatistics& statistics() const { return statistics_; }
  /// Of all blocks, also those that were left out.
  [[nodiscard]] const BlockCounts& counts() const { return counts_; }
  [[nodiscard]] std::uint64_t tiles() const { return tiles_; }
  /// Of the tile that has most.
  [[nodiscard]] std::uint64_t largest_events() const { return largest_events_; }

 private:
  [[nodiscard]] std::vector<TexelRect> open_tiles();
  [[nodiscard]] TexelRect open_part(const TexelRect& tile) const;
  [[nodiscard]] double share_of(const TexelRect& tile) const;
  void take(FittedBlock&& block);
  bool poll(double done);

  const BakeJob& job_;
  const TileInput& input_;
  const TileRunOutput output_;
  std::vector<bool> is_left_out_;
  TileStatistics statistics_;
  BlockCounts counts_;
  std::mutex mutex_;  ///< of the counts
  double start_, last_told_ = 0, done_ = 0, left_out_share_ = 0;
  std::uint64_t tiles_ = 0, largest_events_ = 0;
};

}  // namespace pdsm
