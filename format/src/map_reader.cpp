// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <new>

#include "map_parser.h"
#include "mapped_file.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

/// A checker's list ends here; a file with more faults is broken enough.
constexpr std::size_t kMaxFaults = 100;

}  // namespace

PenumbraMap read_map(std::span<const std::byte> bytes, const std::string& name, const ReadLimits& limits) {
  FaultList faults(1);
  std::vector<std::vector<FunctionBlock>> blocks;
  PenumbraMap map;
  try {
    map = parse_map(bytes, limits, faults, [&](std::size_t image, std::size_t, FunctionBlock&& block) {
      if (blocks.size() <= image) blocks.resize(image + 1);
      blocks[image].push_back(std::move(block));
    });
  } catch (const std::bad_alloc&) {
    throw Error(Failure::resource, name, "not enough memory to read it");
  }
  if (!faults.empty()) {
    const FileFault& fault = faults.list().front();
    throw Error(Failure::input, name + ":offset " + std::to_string(fault.offset),
                "fault " + std::to_string(fault.number) + ": expected " + fault.expected);
  }
  for (std::size_t n = 0; n < blocks.size(); ++n) map.images[n].blocks = std::move(blocks[n]);
  return map;
}

PenumbraMap read_map(const std::filesystem::path& path, const ReadLimits& limits) {
  const MappedFile file(path);
  return read_map(file.bytes(), path.string(), limits);
}

std::optional<std::string> read_metadata(const std::filesystem::path& path, const ReadLimits& limits) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  const MappedFile file(path);
  FaultList faults(1);
  PenumbraMap frame = parse_frame(file.bytes(), limits, faults);
  if (!faults.empty()) return std::nullopt;
  return std::move(frame.metadata);
}

std::vector<FileFault> check_map(std::span<const std::byte> bytes, const ReadLimits& limits) {
  FaultList faults(kMaxFaults);
  static_cast<void>(parse_map(bytes, limits, faults, [](std::size_t, std::size_t, FunctionBlock&&) {}));
  std::stable_sort(faults.list().begin(), faults.list().end(),
                   [](const FileFault& a, const FileFault& b) { return a.offset < b.offset; });
  return std::move(faults.list());
}

std::vector<ChunkSummary> list_chunks(std::span<const std::byte> bytes) {
  FaultList faults(1);
  std::vector<ChunkSummary> chunks;
  const auto table = parse_table(bytes, faults);
  if (!table) return chunks;
  for (const TableEntry& entry : table->entries)
    chunks.push_back({std::string(entry.type.begin(), entry.type.end()), entry.image, entry.stored_size,
                      entry.decoded_size});
  return chunks;
}

}  // namespace pdsm
