// SPDX-License-Identifier: Apache-2.0
// Shards of a bake, which are read and merged, and with them checkpoints, whose records are the same.
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

#include "fuzz_target.h"
#include "part/merge_shards.h"
#include "pdsm/format/map_file.h"

namespace pdsm::testing {
namespace {

using Bytes = std::vector<std::byte>;

// What a small file may decode to here; large ones would only make the fuzzer slow.
constexpr ReadLimits kLimits{std::uint64_t{32} << 20};
constexpr std::uint32_t kMostTexels = 1024;

/// Whether the shard's own map is small enough to be made here.
bool is_small(const DescribedFacts& described) {
  return std::ranges::all_of(described.facts, [](const BakeFacts& facts) {
    const View& view = facts.fitted.view;
    return view.width <= kMostTexels && view.height <= kMostTexels;
  });
}

void merge(const NamedShard& shard) {
  BakedMap merged;
  if (!refused_or_read([&] { merged = merge_contents(std::span(&shard, 1), 1, kLimits); })) return;
  const PenumbraMap map = decode_blocks(merged);
  demand(find_invariant_fault(map).empty(), "a map that holds its invariants");
  demand(merged.report.texels >= merged.report.empty_texels, "counts that add up");
}

void read(std::span<const std::byte> bytes) {
  ShardContents contents;
  DescribedFacts described;
  const bool was_read = refused_or_read([&] {
    contents = read_shard("shard", bytes);
    described = read_facts("shard", contents);
  });
  if (!was_read) return;
  const Bytes again = encode_facts(described);
  demand(again.size() == contents.facts.size() &&
             std::memcmp(again.data(), contents.facts.data(), again.size()) == 0,
         "a description that survives writing");
  if (is_small(described)) merge({"shard", &contents});
}

/// Makes the checksums of header and records right, as far as sizes lead.
void repair_checksums(Bytes& bytes) {
  if (bytes.size() < sizeof(PartHeaderRecord)) return;
  const std::uint64_t of_header = XXH3_64bits(bytes.data(), offsetof(PartHeaderRecord, checksum));
  std::memcpy(bytes.data() + offsetof(PartHeaderRecord, checksum), &of_header, sizeof of_header);
  std::size_t at = sizeof(PartHeaderRecord);
  while (bytes.size() - at >= sizeof(RecordHeader)) {
    RecordHeader header;
    std::memcpy(&header, bytes.data() + at, sizeof header);
    if (header.size > bytes.size() - at - sizeof header) return;
    const std::uint64_t seed = XXH3_64bits(&header, offsetof(RecordHeader, checksum));
    header.checksum = XXH3_64bits_withSeed(bytes.data() + at + sizeof header, header.size, seed);
    std::memcpy(bytes.data() + at, &header, sizeof header);
    at += sizeof header + header.size;
  }
}

}  // namespace
}  // namespace pdsm::testing

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pdsm::testing;
  Bytes bytes(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  read(bytes);
  repair_checksums(bytes);
  read(bytes);
  return 0;
}
