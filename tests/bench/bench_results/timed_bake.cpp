// SPDX-License-Identifier: Apache-2.0
#include "timed_bake.h"

#include <chrono>

#include "evaluate/map_statistics.h"
#include "pdsm/format/map_file.h"
#include "tradeoff/processor_time.h"

namespace pdsm::bench {

TimedBake timed_bake(const Scene& scene, const Light& light, const BakeOptions& options,
                     const std::filesystem::path& scratch) {
  TimedBake timed;
  const double cpu_start = processor_seconds();
  const auto start = std::chrono::steady_clock::now();
  timed.baked = bake(scene, light, options);
  timed.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  timed.cpu_seconds = processor_seconds() - cpu_start;
  const std::filesystem::path file = scratch / "timed.pdsm";
  timed.file_bytes = write_encoded_map(timed.baked.map, timed.baked.blocks, file);
  std::filesystem::remove(file);
  timed.gpu_bytes = texture_bytes(timed.baked);
  return timed;
}

}  // namespace pdsm::bench
