// SPDX-License-Identifier: Apache-2.0
#include "tile/slope_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tile/parallel_failure.h"

namespace pdsm {
namespace {

/// Packets of the grid along each axis.
constexpr std::int32_t kGridPackets = 48;
/// Share of rays that may go free though the next receiver lies in their slope's way.
constexpr double kMayLeak = 0.001;

constexpr double kNone = std::numeric_limits<double>::infinity();

/// First map texel of packet `n` of the grid along `axis`.
std::int32_t packet_texel(const MapGrid& grid, std::size_t axis, std::int32_t n) {
  const double texels = grid.texels[axis] * grid.ratio[axis].maps_per_texel();
  return static_cast<std::int32_t>(texels * n / kGridPackets) / kPacketEdge * kPacketEdge;
}

/// What a grid of rays from the light's centre has met.
struct GridHits {
  std::uint64_t met = 0;
  std::vector<float> blocked;  ///< what slopes add that reach behind the next receiver, metres
};

/// Looks at the rays of packets under three biases: the constant one alone, with the slope's, and with that
/// one limited.
class PacketProbe {
 public:
  PacketProbe(const EmbreeScene& scene, const MapGrid& grid, Walk walk, double constant)
      : scene_(scene),
        grid_(grid),
        centre_(grid.centre_sample()),
        limited_bias_(sample_bias(grid, walk, true, {constant, constant}, centre_)),
        free_bias_(sample_bias(grid, walk, true, {constant, kNone}, centre_)),
        level_bias_{constant, {0, 0}, kNone} {}

  void look(std::int32_t x0, std::int32_t y0, GridHits& hits) {
    const TexelRect rect{x0, y0, x0 + kPacketEdge, y0 + kPacketEdge};
    trace(limited_bias_, rect, limited_);
    trace(free_bias_, rect, free_);
    trace(level_bias_, rect, level_);
    for (std::int32_t y = rect.y0; y < rect.y1; ++y) {
      for (std::int32_t x = rect.x0; x < rect.x1; ++x) {
        hits.met += std::isfinite(level_.at(x, y)) ? 1 : 0;
        if (limited_.at(x, y) < free_.at(x, y)) hits.blocked.push_back(free_.at(x, y) - level_.at(x, y));
      }
    }
  }

 private:
  void trace(const MapBias& bias, const TexelRect& rect, SampleMap& map) {
    map.reset(rect, 1);
    SlopeBiasStatistics unused;
    trace_sample_map(scene_, grid_, centre_, bias, nullptr, map, unused);
  }

  const EmbreeScene& scene_;
  const MapGrid& grid_;
  const LightSample centre_;
  const MapBias limited_bias_, free_bias_, level_bias_;
  SampleMap limited_, free_, level_;
};

GridHits look_at_grid(const EmbreeScene& scene, const MapGrid& grid, Walk walk, double constant,
                      std::uint32_t threads) {
  GridHits all;
  ParallelFailure failure;
#pragma omp parallel num_threads(static_cast <int>(threads))
  {
    PacketProbe probe(scene, grid, walk, constant);
    GridHits own;
#pragma omp for schedule(dynamic) nowait
    for (std::int32_t row = 0; row < kGridPackets; ++row) {
      failure.guard([&] {
        for (std::int32_t n = 0; n < kGridPackets; ++n)
          probe.look(packet_texel(grid, 0, n), packet_texel(grid, 1, row), own);
      });
    }
#pragma omp critical
    {
      all.met += own.met;
      failure.guard([&] { all.blocked.insert(all.blocked.end(), own.blocked.begin(), own.blocked.end()); });
    }
  }
  failure.rethrow();
  return all;
}

}  // namespace

SlopeLimit find_slope_limit(const EmbreeScene& scene, const MapGrid& grid, Walk walk, double constant,
                            std::uint32_t threads) {
  GridHits hits = look_at_grid(scene, grid, walk, constant, threads);
  const auto may_leak = static_cast<std::size_t>(kMayLeak * static_cast<double>(hits.met));
  if (hits.blocked.size() <= may_leak) return {kNone};
  const auto first_kept = hits.blocked.begin() + static_cast<std::ptrdiff_t>(may_leak);
  std::ranges::nth_element(hits.blocked, first_kept);
  return {std::max(constant, static_cast<double>(std::nextafter(*first_kept, 0.0F)))};
}

}  // namespace pdsm
