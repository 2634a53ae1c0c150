// SPDX-License-Identifier: Apache-2.0
#include "part/logged_blocks.h"

#include <mutex>
#include <utility>

#include "part/part_layout.h"
#include "tile/block_grid.h"
#include "tile/block_inputs.h"
#include "tile/parallel_failure.h"

namespace pdsm {

PartShape part_shape(const BakeJob& job, std::uint32_t first_block) {
  return {job.rules.coding,
          job.grid.texels[0],
          job.grid.texels[1],
          job.mip_levels,
          job.options.receivers != Receivers::all,
          first_block};
}

TileRunOutput logged_output(const BakeJob& job, const BakeCallbacks& callbacks, CheckpointLog* log,
                            std::uint32_t first_block, EncodedSink sink) {
  TileRunOutput output;
  output.callbacks = callbacks;
  output.take = [log, first_block, coding = job.rules.coding, sink = std::move(sink)](FittedBlock&& block) {
    EncodedBlock base = encode_block(coding, block.width, block.height, block.levels.front());
    if (log != nullptr) log->keep(coding, block, base, first_block);
    sink(std::move(block), std::move(base));
  };
  if (log == nullptr) return output;
  output.tile_done = [log](const TileStatistics& tile) { log->keep(tile); };
  output.idle = [log] { log->poll(); };
  return output;
}

namespace {

/// Whether a block is of a bake that was not asked for keys, where this one is.
bool lacks_key(const TileInput& input, const FittedBlock& block) {
  return input.block_inputs != nullptr && input.block_inputs->can_tell(block.index) &&
         block.inputs == FittedBlock().inputs;
}

}  // namespace

void take_over(std::span<const PartRecord> records, const BakeJob& job, std::uint32_t first_block,
               const TileInput& input, TileRun& run, const BlockSink& sink) {
  const PartShape shape = part_shape(job, first_block);
  std::vector<bool> is_there(block_count(job.grid));
  std::mutex mutex;
  ParallelFailure failure;
#pragma omp parallel for schedule(dynamic) num_threads(static_cast <int>(job.options.threads))
  for (std::size_t n = 0; n < records.size(); ++n) {
    failure.guard([&] {
      if (records[n].type != kBlockRecord) return;
      auto block = read_block(shape, records[n].payload);
      if (!block || lacks_key(input, *block)) return;
      {
        const std::lock_guard guard(mutex);
        if (is_there[block->index]) return;
        is_there[block->index] = true;
        run.leave_out(block->index, block->counts);
      }
      sink(std::move(*block));
    });
  }
  failure.rethrow();
}

TileStatistics taken_by(std::span<const PartRecord> records) {
  TileStatistics taken;
  for (const PartRecord& record : records) {
    if (record.type != kTileRecord) continue;
    if (const auto tile = read_tile(record.payload)) taken.add(*tile);
  }
  return taken;
}

}  // namespace pdsm
