// SPDX-License-Identifier: Apache-2.0
// A bake against what it can't be without, on one scene, in one process, in turns:
//   trace  the sample maps traced alone: width x height x samples rays, rtcIntersect16, coherent, robust,
//          all threads, the same BVH
//   bake   all of a bake but loading and BVH
//   plain  algorithm 3.1 of the thesis, as it would be written first (plain_bake.h); tracing counts, a fit it
//   has none
// usage: bench_bake SCENE [RUNS] [MAP_EDGE] [SAMPLES] [plain]
#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <vector>

#include "count_argument.h"
#include "pdsm/bake/bake.h"
#include "pdsm/bake/scene_file.h"
#include "pdsm/format/error.h"
#include "plain_bake.h"
#include "tile/bake_job.h"

namespace {

using namespace pdsm;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Rays of one map, packet by packet, and nothing else.
void trace_alone(const BakeJob& job, const LightSample& sample) {
  alignas(64) int valid[16];
  std::fill_n(valid, 16, -1);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRayHit16 packet;
  for (std::uint32_t y = 0; y < job.grid.texels[1]; y += 4) {
    for (std::uint32_t x = 0; x < job.grid.texels[0]; x += 4) {
      for (std::uint32_t lane = 0; lane < 16; ++lane) {
        packet.ray.org_x[lane] = static_cast<float>(sample.position[0]);
        packet.ray.org_y[lane] = static_cast<float>(sample.position[1]);
        packet.ray.org_z[lane] = 0;
        packet.ray.dir_x[lane] = static_cast<float>(job.grid.center_slope(0, x + lane % 4) -
                                                    sample.position[0] / job.grid.focus_depth);
        packet.ray.dir_y[lane] = static_cast<float>(job.grid.center_slope(1, y + lane / 4) -
                                                    sample.position[1] / job.grid.focus_depth);
        packet.ray.dir_z[lane] = 1;
        packet.ray.tnear[lane] = 0;
        packet.ray.tfar[lane] = 1e30F;
        packet.ray.time[lane] = 0;
        packet.ray.mask[lane] = kCasterMask;
        packet.ray.flags[lane] = 0;
        packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect16(valid, job.embree->handle(), &context, &packet);
    }
  }
}

double time_trace(const BakeJob& job) {
  const double start = omp_get_wtime();
#pragma omp parallel for schedule(dynamic) num_threads(static_cast <int>(job.options.threads))
  for (std::size_t n = 0; n < job.samples.size(); ++n) trace_alone(job, job.samples[n]);
  return omp_get_wtime() - start;
}

void run(int argc, char** argv) {
  const Scene scene = read_scene(argv[1]);
  const Light& light = scene.lights.front();
  // What it compares with traces from a point.
  if (is_distant(light)) throw Error(Failure::usage, "SCENE", "the first light must not be distant");
  const std::uint32_t runs = bench::count_argument(argc, argv, 2, 5);
  BakeOptions options;
  options.width = options.height = bench::count_argument(argc, argv, 3, options.width);
  options.samples = bench::count_argument(argc, argv, 4, options.samples);
  options.block_keys = true;  // as `pdsm bake` has them
  const BakeJob job(scene, light, options);
  const bool with_plain = argc > 5 && std::strcmp(argv[5], "plain") == 0;
  std::vector<double> trace, baked, plain, over_trace, over_plain;
  std::uint64_t plain_events = 0;
  BakeReport report;
  std::size_t bytes = 0;
  for (std::uint32_t n = 0; n < runs; ++n) {
    trace.push_back(time_trace(job));
    const BakedMap map = bake(scene, light, options);
    report = map.report;
    bytes = 0;
    for (const EncodedBlock& block : map.blocks[0]) bytes += block.bytes.size();
    baked.push_back(report.seconds_total - report.seconds_bvh);
    over_trace.push_back(baked.back() / trace.back());
    if (!with_plain) continue;
    const double start = omp_get_wtime();
    plain_events = bench::bake_plainly(job);
    plain.push_back(omp_get_wtime() - start);
    over_plain.push_back(baked.back() / plain.back());
  }
  fmt::print("trace_seconds {:.3f}\nbake_seconds {:.3f}\nbake_over_trace {:.3f}\n", median(trace),
             median(baked), median(over_trace));
  fmt::print("rays {}\nevents {}\npieces {}\nblock_bytes {}\n", report.rays, report.events, report.pieces,
             bytes);
  fmt::print("share trace {:.2f} walk {:.2f} accumulate {:.2f} fit {:.2f}\n", report.seconds_trace,
             report.seconds_walk, report.seconds_accumulate, report.seconds_fit);
  if (!with_plain) return;
  fmt::print(
      "plain_seconds {:.3f}\nplain_events {}\nplain_nanoseconds_per_event {:.1f}\nbake_over_plain {:.4f}\n",
      median(plain), plain_events,
      1e9 * median(plain) / static_cast<double>(std::max<std::uint64_t>(plain_events, 1)),
      median(over_plain));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: bench_bake SCENE [RUNS] [MAP_EDGE] [SAMPLES] [plain]\n");
    return 2;
  }
  try {
    run(argc, argv);
  } catch (const pdsm::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return static_cast<int>(error.failure());
  }
}
