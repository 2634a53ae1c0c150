// SPDX-License-Identifier: Apache-2.0
// How libFuzzer varies map files: half the time the bytes of one chunk, with all that follows moved and
// sizes, offsets and checksums right. Without this, each byte put in or taken out breaks every later offset.
#include <algorithm>
#include <cstring>
#include <span>

#include "file_bytes.h"
#include "pdsm/format/map_file.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace pdsm::testing {
namespace {

/// The stored bytes of chunk `index`, changed as libFuzzer likes.
Bytes mutated_chunk(const Bytes& file, std::size_t index, std::size_t room) {
  const auto offset = get<std::uint64_t>(file, entry_at(index) + kOffsetIn);
  const auto size = get<std::uint64_t>(file, entry_at(index) + kStoredIn);
  Bytes stored(size + room);
  std::memcpy(stored.data(), file.data() + offset, size);
  stored.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(stored.data()), size, stored.size()));
  return stored;
}

}  // namespace
}  // namespace pdsm::testing

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  using namespace pdsm::testing;
  // Chunks that follow may need up to 15 bytes of padding each, so room is left for that.
  constexpr std::size_t kPadding = 256;
  Bytes file(size);
  if (size > 0) std::memcpy(file.data(), data, size);
  // A list is complete only where all chunks have their place, which taking a file apart relies on.
  const std::size_t count = size < kHeaderSize ? 0 : pdsm::list_chunks(file).size();
  const bool has_places = count > 0 && count == chunk_count(file);
  if (!has_places || seed % 2 == 0 || size + kPadding > max_size)
    return LLVMFuzzerMutate(data, size, max_size);
  const std::size_t index = seed / 2 % count;
  const Bytes changed = replace_chunk(file, index, mutated_chunk(file, index, max_size - size - kPadding));
  if (changed.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, changed.data(), changed.size());
  return changed.size();
}
