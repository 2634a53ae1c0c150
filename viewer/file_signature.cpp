// SPDX-License-Identifier: Apache-2.0
#include "file_signature.h"

#include <sys/stat.h>

namespace pdsm {

std::optional<FileSignature> file_signature(const std::filesystem::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileSignature{status.st_mtim.tv_sec, status.st_mtim.tv_nsec,
                       static_cast<std::uint64_t>(status.st_size), static_cast<std::uint64_t>(status.st_dev),
                       static_cast<std::uint64_t>(status.st_ino)};
}

}  // namespace pdsm
