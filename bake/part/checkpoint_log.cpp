// SPDX-License-Identifier: Apache-2.0
#include "part/checkpoint_log.h"

#include <utility>

#include "part/part_layout.h"
#include "pdsm/format/error.h"

namespace pdsm {

CheckpointLog::CheckpointLog(CheckpointSettings settings) : settings_(std::move(settings)) {}

CheckpointLog::~CheckpointLog() {
  const std::lock_guard guard(mutex_);
  const std::chrono::duration<double> since_start = Clock::now() - start_;
  if (since_start.count() >= settings_.interval) write();
}

std::vector<PartRecord> CheckpointLog::begin(const PartHeader& header) {
  const std::lock_guard guard(mutex_);
  header_ = header;
  begun_ = true;
  try {
    file_ = PartFile::open(settings_.file, PartFile::Open::existing);
    if (file_) return read();
  } catch (const Error& error) {
    give_up(error.what());
  }
  return {};
}

/// Looks at the open file; throws where it is not one of ours.
void CheckpointLog::map_ours() {
  mapped_.emplace(settings_.file);
  if (!begins_as_part(mapped_->bytes())) {
    throw Error(Failure::resource, settings_.file.string(), "is no checkpoint, and is left alone");
  }
  is_ours_ = true;
}

/// The records of the open file. What does not belong to this bake is replaced by the first write; what is
/// torn or damaged is cut off, with all behind it.
std::vector<PartRecord> CheckpointLog::read() {
  map_ours();
  auto scan = scan_part(mapped_->bytes());
  if (!scan || scan->header != header_) {
    // A header that a kill has cut short is no news to anyone.
    const bool is_torn = mapped_->bytes().size() < sizeof(PartHeaderRecord);
    mapped_.reset();
    if (!is_torn && settings_.notice) {
      settings_.notice(settings_.file.string() +
                       (scan ? ": is of another bake, and is replaced"
                             : ": is damaged or of another version, and is replaced"));
    }
    return {};
  }
  if (scan->good_bytes < mapped_->bytes().size()) file_->cut(scan->good_bytes);
  has_header_ = true;
  return std::move(scan->records);
}

void CheckpointLog::keep(const VertexCoding& coding, const FittedBlock& block, const EncodedBlock& base,
                         std::uint32_t first_block) {
  std::vector<std::byte> bytes;
  append_block(coding, block, base, first_block, bytes);
  add(bytes);
}

void CheckpointLog::keep(const TileStatistics& tile) {
  std::vector<std::byte> bytes;
  append_tile(tile, bytes);
  add(bytes);
}

void CheckpointLog::poll() {
  const std::lock_guard guard(mutex_);
  write_if_due();
}

void CheckpointLog::remove() {
  const std::lock_guard guard(mutex_);
  waiting_.clear();
  gave_up_ = true;
  try {
    if (is_ours_) file_->remove();
  } catch (const Error& error) {
    if (settings_.notice) settings_.notice(error.what());
  }
  file_.reset();
}

void CheckpointLog::discard(const PartHeader& header) {
  const std::lock_guard guard(mutex_);
  gave_up_ = true;
  try {
    file_ = PartFile::open(settings_.file, PartFile::Open::existing);
    if (!file_) return;
    const auto scan = scan_part(MappedFile(settings_.file).bytes());
    if (scan && scan->header == header) file_->remove();
  } catch (const Error&) {
    // It is in nobody's way.
  }
  file_.reset();
}

void CheckpointLog::add(std::span<const std::byte> bytes) {
  const std::lock_guard guard(mutex_);
  if (gave_up_) return;
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  write_if_due();
}

void CheckpointLog::write_if_due() {
  const std::chrono::duration<double> since_write = Clock::now() - last_write_;
  if (since_write.count() >= settings_.interval) write();
}

void CheckpointLog::write() {
  if (gave_up_ || !begun_ || waiting_.empty()) return;
  try {
    if (!file_) {
      file_ = PartFile::open(settings_.file, PartFile::Open::existing_or_new);
      map_ours();
      mapped_.reset();
    }
    if (!has_header_) {
      file_->cut(0);
      std::vector<std::byte> front;
      append_part_header(header_, front);
      file_->append(front);
      has_header_ = true;
    }
    file_->append(waiting_);
    waiting_.clear();
    last_write_ = Clock::now();
  } catch (const Error& error) {
    give_up(error.what());
  }
}

/// The bake goes on without: half a checkpoint is worth less than the room that the result needs.
void CheckpointLog::give_up(const std::string& why) {
  gave_up_ = true;
  waiting_ = {};
  if (settings_.notice) settings_.notice(why + "; going on without a checkpoint");
  mapped_.reset();
  try {
    if (is_ours_) file_->remove();
  } catch (const Error&) {
    // What is left of it is a good checkpoint with a torn end.
  }
  file_.reset();
}

Checkpoint::Checkpoint(CheckpointSettings settings)
    : log_(std::make_unique<CheckpointLog>(std::move(settings))) {}
Checkpoint::~Checkpoint() = default;

void Checkpoint::remove() {
  log_->remove();
}

void Checkpoint::discard(const std::string& key) {
  log_->discard({identity_of(key)});
}

}  // namespace pdsm
