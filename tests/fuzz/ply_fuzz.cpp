// SPDX-License-Identifier: Apache-2.0
// PLY files, ASCII and binary.
#include <string>

#include "fuzz_target.h"
#include "imported_parts.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pdsm::testing;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  refused_or_read([&] { demand_sound(pdsm::import_ply("a.ply", bytes)); });
  return 0;
}
