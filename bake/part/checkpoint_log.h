// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mapped_file.h"
#include "part/part_file.h"
#include "part/part_records.h"
#include "pdsm/bake/checkpoint.h"

namespace pdsm {

/// What stands behind a Checkpoint: reads the file that is there, then appends to it. Blocks wait in memory,
/// as bytes, until the interval has passed.
class CheckpointLog {
 public:
  explicit CheckpointLog(CheckpointSettings settings);
  /// Writes what waits, unless the bake was shorter than the interval.
  ~CheckpointLog();
  CheckpointLog(const CheckpointLog&) = delete;
  CheckpointLog& operator=(const CheckpointLog&) = delete;

  /// Begins a bake. Returns the records of the file that is there, if it is the same bake's; they live until
  /// release_records().
  [[nodiscard]] std::vector<PartRecord> begin(const PartHeader& header);
  void release_records() { mapped_.reset(); }

  /// Takes a finished block; `base` is its level 0, encoded. Any thread.
  void keep(const VertexCoding& coding, const FittedBlock& block, const EncodedBlock& base,
            std::uint32_t first_block);
  /// Takes what a finished tile took. Any thread.
  void keep(const TileStatistics& tile);
  /// Writes what waits, if it is time. Any thread.
  void poll();
  /// Removes the file; nothing is written from here on.
  void remove();
  /// Instead of begin(): removes the file that is there, if it begins with this header and no one writes it.
  void discard(const PartHeader& header);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::vector<PartRecord> read();
  void map_ours();
  void add(std::span<const std::byte> bytes);
  void write_if_due();
  void write();
  void give_up(const std::string& why);

  const CheckpointSettings settings_;
  PartHeader header_;
  std::optional<PartFile> file_;
  std::optional<MappedFile> mapped_;
  std::vector<std::byte> waiting_;
  bool begun_ = false, gave_up_ = false;
  bool is_ours_ = false;     ///< the open file may be written and removed
  bool has_header_ = false;  ///< and begins with our header
  Clock::time_point start_ = Clock::now(), last_write_ = start_;
  std::mutex mutex_;
};

}  // namespace pdsm
