// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>
#include <utility>

#include "tile/tile_run.h"

namespace pdsm::test {

/// All functions of a job that does not obey the shift law, by block; with or without the rays that nothing
/// can darken.
[[nodiscard]] inline std::map<std::uint32_t, FunctionBlock> job_blocks(const BakeJob& job, bool finds_cells) {
  TileInput input = job.tile_input();
  input.finds_cells = finds_cells;
  std::map<std::uint32_t, FunctionBlock> blocks;
  std::mutex mutex;
  TileRun run(job, input,
              {[&](FittedBlock&& block) {
                 const std::lock_guard guard(mutex);
                 blocks[block.index] = std::move(block.levels.front());
               },
               {}});
  run.run();
  return blocks;
}

}  // namespace pdsm::test
