// SPDX-License-Identifier: Apache-2.0
#include "trace/trace_layers.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "trace/cutout_holes.h"
#include "trace/map_rays.h"

namespace pdsm {
namespace {

/// Floats of one surface's depth as its two triangles at an edge have it.
constexpr float kSameDepth = 0x1p-20F;

struct Hit {
  float t = 0;
  unsigned mesh = 0, triangle = 0;
  glm::vec3 normal{0};
  double opacity = 0;
};

/// What the filter fills: CutoutRays first, as filters of casters with holes expect.
struct LayerRays {
  CutoutRays rays;
  const LightSpaceScene* scene;
  std::array<std::vector<Hit>, kMapPacketRays> hits;

  void take(const RTCFilterFunctionNArguments& args, unsigned lane) {
    const unsigned n = args.N;
    Hit hit;
    hit.t = RTCRayN_tfar(args.ray, n, lane);
    hit.mesh = RTCHitN_geomID(args.hit, n, lane);
    hit.triangle = RTCHitN_primID(args.hit, n, lane);
    hit.normal = {RTCHitN_Ng_x(args.hit, n, lane), RTCHitN_Ng_y(args.hit, n, lane),
                  RTCHitN_Ng_z(args.hit, n, lane)};
    const LightSpaceMesh& mesh = scene->meshes[hit.mesh];
    hit.opacity = mesh.opacity * (mesh.blends() ? alpha_met(mesh, rays, args, lane) : 1);
    hits[RTCRayN_id(args.ray, n, lane)].push_back(hit);
  }

  /// Takes every hit and lets the ray go on.
  static void filter(const RTCFilterFunctionNArguments* args) {
    auto& self = *reinterpret_cast<LayerRays*>(args->context);
    for (unsigned lane = 0; lane < args->N; ++lane) {
      if (args->valid[lane] != -1) continue;
      self.take(*args, lane);
      args->valid[lane] = 0;
    }
  }
};

/// Whether two triangles of a mesh have an edge or a corner in common, and aren't copies.
bool are_neighbours(const LightSpaceMesh& mesh, unsigned a, unsigned b) {
  int shared = 0;
  for (int i = 0; i < 3; ++i) {
    const glm::vec3& p = mesh.positions[mesh.triangles[a][i]];
    for (int j = 0; j < 3; ++j) shared += p == mesh.positions[mesh.triangles[b][j]] ? 1 : 0;
  }
  return shared == 1 || shared == 2;
}

bool is_same_surface(const LightSpaceScene& scene, const Hit& a, const Hit& b) {
  // Embree may tell a filter of one hit more than once.
  return a.mesh == b.mesh && b.t - a.t <= kSameDepth * b.t &&
         (a.triangle == b.triangle || are_neighbours(scene.meshes[a.mesh], a.triangle, b.triangle));
}

/// Near to far, each surface once.
void put_in_order(const LightSpaceScene& scene, std::vector<Hit>& hits) {
  const auto key = [](const Hit& hit) { return std::tie(hit.t, hit.mesh, hit.triangle); };
  std::ranges::sort(hits, [&](const Hit& a, const Hit& b) { return key(a) < key(b); });
  std::size_t kept = 0;
  for (const Hit& hit : hits) {
    bool is_known = false;
    for (std::size_t n = kept; n-- > 0 && hit.t - hits[n].t <= kSameDepth * hit.t && !is_known;)
      is_known = is_same_surface(scene, hits[n], hit);
    if (!is_known) hits[kept++] = hit;
  }
  hits.resize(kept);
}

/// What the rays of a packet meet of translucent surfaces.
class SurfaceTrace {
 public:
  SurfaceTrace(const EmbreeScene& scene, const MapGrid& grid, const LightSample& sample, const MapBias& bias)
      : scene_(scene),
        map_rays_(grid, sample),
        bias_(scene, grid, sample, bias),
        layer_rays_{{grid, sample}, &scene.geometry(), {}} {
    layer_rays_.rays.context.filter = LayerRays::filter;
  }

  /// Whether anything is met by the rays of the packet at (x, y).
  bool trace(std::int32_t x, std::int32_t y) {
    alignas(64) static constexpr std::array<int, kMapPacketRays> kAll{-1, -1, -1, -1, -1, -1, -1, -1,
                                                                      -1, -1, -1, -1, -1, -1, -1, -1};
    most_ = 0;
    for (auto& hits : layer_rays_.hits) hits.clear();
    for (auto& of_lane : surfaces_) of_lane.clear();
    if (scene_.translucent() == nullptr) return false;
    map_rays_.fill(packet_, x, y);
    std::fill_n(packet_.ray.mask, kMapPacketRays, kTranslucentMask | kCutoutMask);
    layer_rays_.rays.set_packet(x, y);
    rtcIntersect16(kAll.data(), scene_.translucent(), &layer_rays_.rays.context, &packet_);
    for (auto& hits : layer_rays_.hits) {
      put_in_order(scene_.geometry(), hits);
      most_ = std::max(most_, hits.size());
    }
    return most_ > 0;
  }

  /// Finds the biased depths of what was met.
  void add_biases(SlopeBiasStatistics& statistics) {
    for (std::size_t n = 0; n < most_; ++n) add_nth(n, statistics);
    for (auto& of_lane : surfaces_) std::ranges::stable_sort(of_lane, {}, &MetSurface::depth);
  }

  /// Of a lane, near to far.
  [[nodiscard]] std::vector<MetSurface>& surfaces(int lane) {
    return surfaces_[static_cast<std::size_t>(lane)];
  }

 private:
  void add_nth(std::size_t n, SlopeBiasStatistics& statistics) {
    for (int lane = 0; lane < kMapPacketRays; ++lane) {
      const auto& hits = layer_rays_.hits[static_cast<std::size_t>(lane)];
      packet_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      if (n >= hits.size()) continue;
      packet_.hit.geomID[lane] = hits[n].mesh;
      packet_.hit.Ng_x[lane] = hits[n].normal.x;
      packet_.hit.Ng_y[lane] = hits[n].normal.y;
      packet_.hit.Ng_z[lane] = hits[n].normal.z;
      packet_.ray.tfar[lane] = hits[n].t;
    }
    alignas(64) std::array<float, kMapPacketRays> slopes;
    bias_.slope_biases(packet_, slopes.data());
    for (std::size_t lane = 0; lane < kMapPacketRays; ++lane) {
      const auto& hits = layer_rays_.hits[lane];
      if (n >= hits.size()) continue;
      surfaces_[lane].push_back(
          {map_rays_.origin_z() + hits[n].t + bias_.constant() + slopes[lane], hits[n].opacity});
      statistics.sum += static_cast<double>(slopes[lane]);
      statistics.max = std::max(statistics.max, slopes[lane]);
    }
  }

  const EmbreeScene& scene_;
  const MapRays map_rays_;
  const SurfaceBias bias_;
  LayerRays layer_rays_;
  RTCRayHit16 packet_;
  std::size_t most_ = 0;
  std::array<std::vector<MetSurface>, kMapPacketRays> surfaces_;
};

/// What they meet of volumes.
class VolumeTrace {
 public:
  VolumeTrace(VolumeLayers& layers, const MapGrid& grid, const LightSample& sample)
      : layers_(layers),
        map_rays_(grid, sample),
        begin_(first_caster_depth(grid, sample)),
        far_(grid.far_depth),
        origin_z_(grid.perspective() ? sample.position[2] : 0) {}

  /// Adds it, of texel (x, y), to surfaces that are in order; `opaque`: the depth that ends the ray.
  void add(std::int32_t x, std::int32_t y, float opaque, std::vector<MetSurface>& surfaces) {
    const auto surface_count = static_cast<std::ptrdiff_t>(surfaces.size());
    const double end = std::min(static_cast<double>(opaque), far_) - origin_z_;
    layers_.append(map_rays_.ray(x, y), begin_, end, origin_z_, surfaces);
    std::inplace_merge(surfaces.begin(), surfaces.begin() + surface_count, surfaces.end(),
                       [](const MetSurface& a, const MetSurface& b) { return a.depth < b.depth; });
  }

 private:
  VolumeLayers& layers_;
  const MapRays map_rays_;
  double begin_, far_, origin_z_;
};

}  // namespace

std::uint64_t trace_layers(const EmbreeScene& scene, VolumeLayers& volumes, const MapGrid& grid,
                           const LightSample& sample, const MapBias& bias, const PacketMask* mask,
                           const SampleMap& map, std::uint32_t unit, LayerMap& layers,
                           SlopeBiasStatistics& statistics) {
  SurfaceTrace surface_trace(scene, grid, sample, bias);
  VolumeTrace volume_trace(volumes, grid, sample);
  std::uint64_t traced = 0;
  const TexelRect& rect = map.rect();
  layers.reset(rect);
  for (std::int32_t y = rect.y0; y < rect.y1; y += kPacketEdge) {
    for (std::int32_t x = rect.x0; x < rect.x1; x += kPacketEdge) {
      if (mask != nullptr && !mask->is_wanted(x, y)) continue;
      traced += kMapPacketRays;
      if (surface_trace.trace(x, y)) surface_trace.add_biases(statistics);
      bool any = false;
      for (int lane = 0; lane < kMapPacketRays; ++lane) {
        const std::int32_t i = x + lane % kPacketEdge, j = y + lane / kPacketEdge;
        volume_trace.add(i, j, map.at(i, j), surface_trace.surfaces(lane));
        any = any || !surface_trace.surfaces(lane).empty();
      }
      if (!any) continue;
      layers.begin_packet(x, y);
      for (int lane = 0; lane < kMapPacketRays; ++lane)
        layers.append(surface_trace.surfaces(lane), map.at(x + lane % kPacketEdge, y + lane / kPacketEdge),
                      unit);
    }
  }
  return traced;
}

}  // namespace pdsm
