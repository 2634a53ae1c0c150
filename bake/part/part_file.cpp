// SPDX-License-Identifier: Apache-2.0
#include "part/part_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw Error(Failure::resource, path.string(), reason);
}

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, int code) {
  fail(path, std::string(what) + ": " + std::generic_category().message(code));
}

/// Whether `path` still names the file that is open.
bool is_at(const std::filesystem::path& path, int descriptor) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// Takes the lock; false where the file went away meanwhile.
bool lock(const std::filesystem::path& path, int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail(path, "cannot read", errno);
  if (!S_ISREG(status.st_mode)) fail(path, "is not a regular file");
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) fail(path, "another bake is writing it");
    fail(path, "cannot lock", errno);
  }
  return is_at(path, descriptor);
}

}  // namespace

std::optional<PartFile> PartFile::open(const std::filesystem::path& path, Open how) {
  // Without O_NONBLOCK the open of a pipe would wait.
  const int flags =
      O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_APPEND | (how == Open::existing_or_new ? O_CREAT : 0);
  for (;;) {
    const int descriptor = ::open(path.c_str(), flags, 0666);
    if (descriptor < 0 && errno == ENOENT && how == Open::existing) return {};
    if (descriptor < 0) fail(path, "cannot write", errno);
    PartFile file(path, descriptor);
    if (lock(path, descriptor)) return file;
  }
}

PartFile::PartFile(PartFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

PartFile& PartFile::operator=(PartFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

PartFile::~PartFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void PartFile::cut(std::uint64_t size) {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail(path_, "cannot write", errno);
}

void PartFile::append(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path_, "cannot write", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void PartFile::remove() {
  if (::unlink(path_.c_str()) != 0 && errno != ENOENT) fail(path_, "cannot remove", errno);
}

}  // namespace pdsm
