// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "pdsm/format/map_file.h"

namespace pdsm {

/// The numbers of FORMAT.md section 8. They never change their meaning; new ones are added.
enum FaultNumber : int {
  kFaultTooShort = 1,
  kFaultMagic = 2,
  kFaultMajorVersion = 3,
  kFaultHeaderChecksum = 4,
  kFaultFileSize = 5,
  kFaultTableSize = 6,
  kFaultTableChecksum = 7,

  kFaultEntryFlags = 20,
  kFaultEntryReserved = 21,
  kFaultChunkOffset = 22,
  kFaultChunkSize = 23,
  kFaultFileEnd = 24,
  kFaultUnknownCritical = 25,
  kFaultChunkOrder = 26,
  kFaultChunkKey = 27,
  kFaultEncoding = 28,
  kFaultDecodedSize = 29,
  kFaultLimit = 30,
  kFaultPadding = 31,
  kFaultChunkChecksum = 32,
  kFaultDecompression = 33,

  kFaultMapSize = 40,
  kFaultMapReserved = 41,
  kFaultCoding = 42,
  kFaultView = 43,
  kFaultLayer = 44,
  kFaultImage = 45,
  kFaultBlockCount = 46,
  kFaultSample = 50,
  kFaultMetadata = 51,
  kFaultBlockKeys = 52,

  kFaultBlockSize = 60,
  kFaultBlockReserved = 61,
  kFaultFunctionOffsets = 62,
  kFaultVertexDepth = 63,
  kFaultVertexValue = 64,
  kFaultLastVertex = 65,
  kFaultVertexBits = 66,
  kFaultDomainEnd = 67,
};

/// Faults in the order they are found, up to a capacity.
class FaultList {
 public:
  explicit FaultList(std::size_t capacity) : capacity_(capacity) {}

  void add(int number, std::uint64_t offset, std::string expected) {
    if (!full()) faults_.push_back({number, offset, std::move(expected)});
  }
  [[nodiscard]] bool full() const { return faults_.size() >= capacity_; }
  [[nodiscard]] bool empty() const { return faults_.empty(); }
  [[nodiscard]] std::size_t size() const { return faults_.size(); }
  [[nodiscard]] std::vector<FileFault>& list() { return faults_; }

 private:
  std::size_t capacity_;
  std::vector<FileFault> faults_;
};

}  // namespace pdsm
