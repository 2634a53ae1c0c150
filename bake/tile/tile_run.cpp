// SPDX-License-Identifier: Apache-2.0
#include "tile/tile_run.h"

#include <omp.h>

#include <algorithm>
#include <cassert>
#include <deque>
#include <utility>

#include "pdsm/format/error.h"
#include "tile/block_grid.h"

namespace pdsm {
namespace {

/// Halves a tile along its longer side, at a block border. Empty when it is one block already.
std::vector<TexelRect> split_tile(const TexelRect& tile) {
  const auto edge = static_cast<std::int32_t>(kBlockSize);
  const std::int32_t across = blocks_along(tile.x1 - tile.x0), up = blocks_along(tile.y1 - tile.y0);
  if (across == 1 && up == 1) return {};
  TexelRect first = tile, second = tile;
  if (across >= up)
    first.x1 = second.x0 = tile.x0 + across / 2 * edge;
  else
    first.y1 = second.y0 = tile.y0 + up / 2 * edge;
  return {first, second};
}

}  // namespace

TileRun::TileRun(const BakeJob& job, const TileInput& input, TileRunOutput output)
    : job_(job),
      input_(input),
      output_(std::move(output)),
      is_left_out_(block_count(job.grid)),
      start_(omp_get_wtime()) {}

void TileRun::leave_out(std::uint32_t block, const BlockCounts& counts) {
  assert(!is_left_out_[block]);
  is_left_out_[block] = true;
  counts_.add(counts);
  left_out_share_ += share_of(block_rect(job_.grid, block));
}

void TileRun::run() {
  const std::vector<TexelRect> tiles = open_tiles();
  std::deque<TexelRect> todo(tiles.begin(), tiles.end());
  done_ = left_out_share_;
  while (!todo.empty()) {
    if (poll(done_)) throw Error(Failure::interrupted, "bake", "interrupted");
    const TexelRect tile = todo.front();
    todo.pop_front();
    const double share = share_of(tile);
    const std::uint64_t events_before = counts_.events;
    TileStatistics taken;
    const TileOutcome outcome = bake_tile(
        input_, tile, job_.plan.strips, job_.plan.event_limit,
        [this](FittedBlock&& block) { take(std::move(block)); },
        [&](double part) { return poll(done_ + share * part); }, taken);
    statistics_.add(taken);
    if (outcome == TileOutcome::cancelled) throw Error(Failure::interrupted, "bake", "interrupted");
    if (outcome == TileOutcome::done) {
      largest_events_ = std::max(largest_events_, counts_.events - events_before);
      done_ += share;
      ++tiles_;
      if (output_.tile_done) output_.tile_done(taken);
      continue;
    }
    const std::vector<TexelRect> halves = split_tile(tile);
    if (halves.empty())
      throw Error(Failure::resource, "--memory", "too little for the events of one block of 64 x 64 texels");
    todo.insert(todo.begin(), halves.begin(), halves.end());
  }
}

/// The tiles of the plan, cut to the blocks that they still lack.
std::vector<TexelRect> TileRun::open_tiles() {
  std::vector<TexelRect> tiles;
  for (const TexelRect& tile : job_.plan.tiles) {
    const TexelRect part = open_part(tile);
    if (part.x0 < part.x1) tiles.push_back(part);
  }
  return tiles;
}

/// The smallest part of `tile` that has all of its blocks that are not left out; empty where none is.
TexelRect TileRun::open_part(const TexelRect& tile) const {
  TexelRect part{tile.x1, tile.y1, tile.x0, tile.y0};
  const auto edge = static_cast<std::int32_t>(kBlockSize);
  for (std::int32_t y = tile.y0; y < tile.y1; y += edge) {
    for (std::int32_t x = tile.x0; x < tile.x1; x += edge) {
      if (is_left_out_[block_at(job_.grid, x, y)]) continue;
      part = {std::min(part.x0, x), std::min(part.y0, y), std::max(part.x1, std::min(x + edge, tile.x1)),
              std::max(part.y1, std::min(y + edge, tile.y1))};
    }
  }
  return part;
}

double TileRun::share_of(const TexelRect& tile) const {
  return static_cast<double>(tile.area()) / job_.grid.texels[0] / job_.grid.texels[1];
}

/// A tile that was cut to its open blocks may still cover others.
void TileRun::take(FittedBlock&& block) {
  if (is_left_out_[block.index]) return;
  {
    const std::lock_guard lock(mutex_);
    counts_.add(block.counts);
  }
  output_.take(std::move(block));
}

bool TileRun::poll(double done) {
  const double now = omp_get_wtime();
  if (output_.callbacks.progress && now - last_told_ > 0.1) {
    last_told_ = now;
    const double rays = (done - left_out_share_) * static_cast<double>(job_.plan.rays);
    const double rate = std::max(rays, 0.0) / std::max(now - start_, 1e-9);
    output_.callbacks.progress({"bake", done, rate});
  }
  if (output_.idle) output_.idle();
  return output_.callbacks.cancelled && output_.callbacks.cancelled();
}

}  // namespace pdsm
