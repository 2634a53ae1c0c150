// SPDX-License-Identifier: Apache-2.0
// OpenEXR deep images that claim to be penumbra maps.
#include "fuzz_target.h"
#include "pdsm/format/deep_exr.h"
#include "pdsm/format/map_file.h"
#include "scratch_input.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pdsm::testing;
  static const ScratchInput scratch;
  const auto path = scratch.write("map.exr", {data, size});
  refused_or_read([&] {
    const pdsm::PenumbraMap map = pdsm::import_deep_exr(path);
    demand(pdsm::find_invariant_fault(map).empty(), "a map that holds its invariants");
  });
  return 0;
}
