// SPDX-License-Identifier: Apache-2.0
#include "part/shard_file.h"

#include <cmath>

#include "bytes.h"
#include "pdsm/bake/shard.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
  throw Error(Failure::input, name, reason);
}

EndRecord read_end(const std::string& name, std::span<const std::byte> payload) {
  ByteReader reader(payload);
  const auto end = reader.value<EndRecord>();
  bool is_sound = reader.ok() && reader.remaining() == 0 && end.threads >= 1;
  for (const double x : {end.threads, end.seconds_bvh, end.seconds_total})
    is_sound = is_sound && std::isfinite(x) && x >= 0;
  if (!is_sound) refuse(name, "the last record is damaged");
  return end;
}

void take_record(const std::string& name, const PartRecord& record, ShardContents& shard) {
  if (record.type == kBakeRecord) {
    if (shard.facts.data() != nullptr) refuse(name, "describes its bake twice");
    shard.facts = record.payload;
  } else if (record.type == kBlockRecord) {
    shard.blocks.push_back(record.payload);
  } else if (record.type == kTileRecord) {
    const auto tile = read_tile(record.payload);
    if (!tile) refuse(name, "what its tiles took is damaged");
    shard.taken.add(*tile);
  }
}

}  // namespace

ShardContents read_shard(const std::string& name, std::span<const std::byte> bytes) {
  if (bytes.empty() || !begins_as_part(bytes)) refuse(name, "is no shard of a bake");
  const auto scan = scan_part(bytes);
  if (!scan) refuse(name, "the header is damaged or of another version");
  if (scan->good_bytes != bytes.size())
    refuse(name + ":offset " + std::to_string(scan->good_bytes), "a record is damaged or cut short");
  if (scan->header.shares > kMostShares) refuse(name, "the header is damaged or of another version");
  if (scan->records.empty() || scan->records.back().type != kEndRecord)
    refuse(name, "is unfinished: its bake has not come to its end");
  ShardContents shard;
  shard.header = scan->header;
  for (const PartRecord& record : scan->records) take_record(name, record, shard);
  if (shard.facts.data() == nullptr) refuse(name, "does not describe its bake");
  shard.end = read_end(name, scan->records.back().payload);
  if (shard.end.blocks != shard.blocks.size()) refuse(name, "does not hold the blocks that it counts");
  return shard;
}

DescribedFacts read_facts(const std::string& name, const ShardContents& shard) {
  auto facts = decode_facts(shard.facts);
  if (!facts) refuse(name, "the description of its bake is damaged");
  return std::move(*facts);
}

}  // namespace pdsm
