// SPDX-License-Identifier: Apache-2.0
#include "scene/file_source.h"

#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

// What a packed file may unpack to: a scene that large does not fit the baker either.
constexpr std::uint64_t kMaxUnpackedBytes = std::uint64_t{8} << 30;

/// Throws unless `path` names a regular file, without opening it: opening a FIFO would block.
void check_regular_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const auto refuse = [&](const std::string& reason) { throw Error(Failure::input, path.string(), reason); };
  if (status.type() == fs::file_type::not_found) refuse("no such file");
  if (error) refuse("cannot be read: " + error.message());
  if (status.type() == fs::file_type::directory) refuse("is a directory, not a file");
  if (status.type() != fs::file_type::regular) refuse("is not a regular file");
}

std::string read_whole(const fs::path& path, std::uint64_t limit) {
  check_regular_file(path);
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw Error(Failure::input, path.string(), std::string("cannot be read: ") + std::strerror(errno));
  std::error_code error;
  const std::uint64_t size = fs::file_size(path, error);
  if (error) throw Error(Failure::input, path.string(), "cannot be read: " + error.message());
  if (size > limit)
    throw Error(Failure::input, path.string(), "is larger than " + std::to_string(limit) + " bytes");
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uint64_t>(stream.gcount()) != size) {
    throw Error(Failure::input, path.string(), "ends before its size");
  }
  return bytes;
}

}  // namespace

struct FileSource::Hash {
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state{XXH3_createState()};
};

FileSource::FileSource() : hash_(std::make_unique<Hash>()) {
  if (!hash_->state) throw std::bad_alloc();
  XXH3_64bits_reset(hash_->state.get());
}

FileSource::~FileSource() = default;

std::string FileSource::read(const fs::path& path, std::uint64_t limit) {
  std::string bytes = read_whole(path, limit);
  if (hashed_.insert(path).second) {
    XXH3_64bits_update(hash_->state.get(), bytes.data(), bytes.size());
    files_.push_back(path);
  }
  return bytes;
}

std::string FileSource::read_unpacked(const fs::path& path) {
  std::string bytes = read(path);
  return has_extension(path, ".gz") ? gunzip(bytes, path.string(), kMaxUnpackedBytes) : bytes;
}

std::uint64_t FileSource::content_hash() const {
  return XXH3_64bits_digest(hash_->state.get());
}

bool has_extension(const fs::path& path, const std::string& extension) {
  const std::string own = path.extension().string();
  // Not tolower(): what it does depends on the locale.
  return std::ranges::equal(own, extension, [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

}  // namespace pdsm
