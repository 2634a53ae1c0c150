// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

/// Bakes that go on after they were interrupted or killed.
namespace pdsm {

class CheckpointLog;

struct CheckpointSettings {
  std::filesystem::path file;  ///< beside the output, by convention the output's name and ".partial"
  /// Seconds between two writes, >= 0; nothing is written before the first have passed, 0 writes each block.
  double interval = 10;
  /// Told one line, "file: reason", when a checkpoint is passed over or can't be written. From any thread of
  /// the bake, one at a time. May be empty.
  std::function<void(const std::string&)> notice;
};

/// A file that holds the finished blocks of a bake until the result is safe (docs/part-files.md). Given to
/// bake(), that first takes over what the file holds of the same bake - the same geometry, light, options
/// that decide about bytes, instruction set and version - and then adds what it finishes. A file of another
/// bake is replaced, one that another process is writing and one that is no checkpoint are left alone, and so
/// is any fault of the file system: a bake never fails because of its checkpoint. Safe on any bytes.
class Checkpoint {
 public:
  explicit Checkpoint(CheckpointSettings settings);
  /// Leaves the file for the next bake, unless remove() was called.
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  /// Call when the result has been written: the file goes.
  void remove();

  /// Call instead of bake() when a map of this key (map_key.h) is there: what a bake of it has left that was
  /// killed right after writing its result goes, all else stays.
  void discard(const std::string& key);

  /// For bake().
  [[nodiscard]] CheckpointLog& log() { return *log_; }

 private:
  std::unique_ptr<CheckpointLog> log_;
};

}  // namespace pdsm
