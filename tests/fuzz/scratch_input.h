// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace pdsm::testing {

/// A folder of this process for readers that insist on files. Its end removes it, which libFuzzer never lets
/// happen to objects of static lifetime; tests/fuzz/run gives it a place that is removed as a whole.
class ScratchInput {
 public:
  ScratchInput();
  ~ScratchInput();
  ScratchInput(const ScratchInput&) = delete;
  ScratchInput& operator=(const ScratchInput&) = delete;

  /// Writes the file `name` of the folder anew and returns its path.
  std::filesystem::path write(const std::string& name, std::span<const std::uint8_t> bytes) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace pdsm::testing
