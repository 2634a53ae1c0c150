// SPDX-License-Identifier: Apache-2.0
#include "pdsm/format/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Writers that live at the same time and still get their temporaries removed by a signal handler. More
/// of them work, too, but for that.
constexpr int kSlotCount = 64;

/// Whether a slot's path may be read by a signal handler.
enum class SlotState : int { unused, filling, live };

struct Slot {
  std::atomic<SlotState> state{SlotState::unused};
  char path[PATH_MAX] = {};
};
static_assert(std::atomic<SlotState>::is_always_lock_free, "a signal handler must not wait");

Slot slots[kSlotCount];

/// Takes a slot for `path`; -1 where none is left or the path is too long for one.
int take_slot(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (int n = 0; n < kSlotCount; ++n) {
    SlotState expected = SlotState::unused;
    if (!slots[n].state.compare_exchange_strong(expected, SlotState::filling)) continue;
    std::memcpy(slots[n].path, path.c_str(), path.size() + 1);
    slots[n].state.store(SlotState::live);
    return n;
  }
  return -1;
}

void free_slot(int slot) {
  if (slot >= 0) slots[slot].state.store(SlotState::unused);
}

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, int code) {
  throw Error(Failure::resource, path.string(),
              std::string(what) + ": " + std::generic_category().message(code));
}

/// A name in the folder of `path` that no other writer uses; short, so that it fits where `path` does.
std::filesystem::path temporary_name(const std::filesystem::path& path) {
  static std::atomic<unsigned> counter{0};
  std::random_device random;
  return path.parent_path() / (".pdsm-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + "-" +
                               std::to_string(random()) + ".tmp");
}

/// The file behind symbolic links, absolute, so that a link stays one and a later chdir does no harm.
std::filesystem::path resolve(const std::filesystem::path& path) {
  std::error_code code;
  std::filesystem::path target = std::filesystem::absolute(path, code);
  if (code) fail(path, "cannot resolve", code.value());
  if (std::filesystem::is_symlink(target, code)) {
    target = std::filesystem::weakly_canonical(target, code);
    if (code) fail(path, "cannot resolve", code.value());
  }
  return target;
}

/// Renaming onto a device or a pipe would destroy it, onto a folder fails only after all the work.
void refuse_other_than_files(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return;
  if (S_ISDIR(status.st_mode)) fail(path, "cannot write", EISDIR);
  if (!S_ISREG(status.st_mode))
    throw Error(Failure::resource, path.string(), "cannot write: not a regular file");
}

/// fsync of a folder, so that a rename in it survives a power cut. Some file systems can't: no harm.
bool sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno == EACCES;
  const bool synced = ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP;
  const int code = errno;
  ::close(descriptor);
  errno = code;
  return synced;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(resolve(path)) {
  if (!path_.has_filename()) fail(path, "cannot write", EISDIR);
  refuse_other_than_files(path_);
  // The slot is taken before the file exists: a signal in between unlinks nothing.
  do {
    free_slot(slot_);
    temporary_ = temporary_name(path_);
    slot_ = take_slot(temporary_.string());
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) {
    const int code = errno;
    free_slot(slot_);
    fail(path, "cannot write", code);
  }
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
    ::unlink(temporary_.c_str());
  }
  free_slot(slot_);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path_, "cannot write", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  if (::fsync(descriptor_) != 0) fail(path_, "cannot write", errno);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "cannot rename to it", errno);

  // From here on the new file is in place and there is no temporary.
  const int code = ::close(std::exchange(descriptor_, -1)) == 0 ? 0 : errno;
  free_slot(std::exchange(slot_, -1));
  if (code != 0) fail(path_, "cannot close", code);
  if (!sync_folder(path_.parent_path())) fail(path_, "cannot sync its folder", errno);
}

void AtomicFile::remove_temporaries() noexcept {
  const int code = errno;
  for (Slot& slot : slots) {
    if (slot.state.load() == SlotState::live) ::unlink(slot.path);
  }
  errno = code;
}

}  // namespace pdsm
