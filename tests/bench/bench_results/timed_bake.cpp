// SPDX-License-Identifier: Apache-2.0
#include "timed_bake.h"

#include <sys/resource.h>

#include <chrono>

#include "evaluate/map_statistics.h"
#include "pdsm/format/map_file.h"

namespace pdsm::bench {
namespace {

double cpu_now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

TimedBake timed_bake(const Scene& scene, const Light& light, const BakeOptions& options,
                     const std::filesystem::path& scratch) {
  TimedBake timed;
  const double cpu_start = cpu_now();
  const auto start = std::chrono::steady_clock::now();
  timed.baked = bake(scene, light, options);
  timed.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  timed.cpu_seconds = cpu_now() - cpu_start;
  const std::filesystem::path file = scratch / "timed.pdsm";
  timed.file_bytes = write_encoded_map(timed.baked.map, timed.baked.blocks, file);
  std::filesystem::remove(file);
  timed.gpu_bytes = texture_bytes(timed.baked);
  return timed;
}

}  // namespace pdsm::bench
