// SPDX-License-Identifier: Apache-2.0
#include "truth/translucent_surfaces.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include "truth/cutout_surface.h"

namespace pdsm {
namespace {

/// Weights this small are those of an edge, and depths this close the same, in float.
constexpr float kEdge = 1e-6F, kSameDepth = 1e-6F;

/// Whether b is a again, which filters may be told of, or the other triangle of the edge at which a crosses
/// the surface.
bool is_repeated(const TranslucentSurfaces::Crossing& a, const TranslucentSurfaces::Crossing& b) {
  if (a.geometry != b.geometry) return false;
  return a.triangle == b.triangle || (a.at_edge && b.at_edge && std::abs(b.t - a.t) <= kSameDepth * b.t);
}

}  // namespace

TranslucentSurfaces::TranslucentSurfaces(const Scene& scene, const WorldScene& casters) : casters_(casters) {
  std::ranges::for_each(scene.geometry, check_opacity);
  if (std::ranges::none_of(scene.geometry, is_translucent_caster)) return;
  for (const Geometry& geometry : scene.geometry) {
    Surface& surface = surfaces_.emplace_back();
    surface.opacity = geometry.opacity;
    if (geometry.mesh && geometry.mesh->mask && geometry.mesh->mask->blends)
      surface.blending = geometry.mesh->mask;
  }
}

bool TranslucentSurfaces::cross(const RTCFilterFunctionNArguments& args, unsigned lane,
                                Crossings& crossings) const {
  if (empty()) return false;
  const unsigned n = args.N, id = RTCHitN_geomID(args.hit, n, lane);
  if (id >= surfaces_.size()) return false;  // curves are opaque
  const Surface& surface = surfaces_[id];
  if (surface.is_opaque()) return false;
  const float u = RTCHitN_u(args.hit, n, lane), v = RTCHitN_v(args.hit, n, lane);
  const unsigned triangle = RTCHitN_primID(args.hit, n, lane);
  double opacity = surface.opacity;
  if (surface.blending) opacity *= mask_alpha(*surface.blending, casters_.mask_place(id, triangle, u, v));
  crossings.push_back(
      {RTCRayN_tfar(args.ray, n, lane), id, triangle, std::min({u, v, 1 - u - v}) <= kEdge, opacity});
  return true;
}

double TranslucentSurfaces::share_kept(Crossings& crossings) const {
  const auto key = [](const Crossing& c) { return std::tie(c.t, c.geometry, c.triangle); };
  std::ranges::sort(crossings, [&](const Crossing& a, const Crossing& b) { return key(a) < key(b); });
  double passed = 1;
  for (std::size_t n = 0; n < crossings.size(); ++n) {
    const auto before = std::span(crossings).first(n);
    const bool known =
        std::ranges::any_of(before, [&](const Crossing& c) { return is_repeated(c, crossings[n]); });
    if (!known) passed *= 1 - crossings[n].opacity;
  }
  return 1 - passed;
}

}  // namespace pdsm
