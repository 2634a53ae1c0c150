// SPDX-License-Identifier: Apache-2.0
#include "trace/map_reach.h"

#include <algorithm>

#include "light/light_spread.h"

namespace pdsm {
namespace {

/// Map texels beside the window: rays look at texels around their own, moved by jitter, and the slopes of
/// surfaces are looked at in whole packets of rays.
constexpr double kBesideTexels = 8;
/// Share of far behind it: receivers are looked for from a thousandth behind far.
constexpr double kBehindFar = 0x1p-8;

constexpr std::uint32_t kUnused = ~std::uint32_t{0};

/// Vertices that triangles use, in order, under new numbers.
void drop_unused_vertices(LightSpaceMesh& mesh) {
  std::vector<std::uint32_t> number(mesh.positions.size(), kUnused);
  for (const glm::uvec3& t : mesh.triangles) number[t.x] = number[t.y] = number[t.z] = 0;
  std::uint32_t count = 0;
  for (std::size_t n = 0; n < number.size(); ++n) {
    if (number[n] == kUnused) continue;
    mesh.positions[count] = mesh.positions[n];
    if (mesh.mask) mesh.mask_places[count] = mesh.mask_places[n];
    number[n] = count++;
  }
  mesh.positions.resize(count);
  if (mesh.mask) mesh.mask_places.resize(count);
  for (glm::uvec3& t : mesh.triangles) t = {number[t.x], number[t.y], number[t.z]};
}

void keep_within(LightSpaceMesh& mesh, const ConvexRegion& region) {
  std::vector<std::uint8_t> outside;
  outside.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions)
    outside.push_back(static_cast<std::uint8_t>(region.outside_bits(glm::dvec3(p))));
  const auto is_outside = [&](const glm::uvec3& t) {
    return (outside[t.x] & outside[t.y] & outside[t.z]) != 0;
  };
  std::erase_if(mesh.triangles, is_outside);
  drop_unused_vertices(mesh);
}

bool lies_outside(const LightSpaceHull& hull, const ConvexRegion& region) {
  std::uint32_t outside = ~std::uint32_t{0};
  for (const glm::vec3& p : hull.surface.positions) outside &= region.outside_bits(glm::dvec3(p));
  return outside != 0;
}

}  // namespace

ConvexRegion map_reach(const LightFace& face, const MapGrid& grid) {
  Window window{};
  for (std::size_t a = 0; a < 2; ++a) {
    const double beside = kBesideTexels * grid.pitch[a];
    window[a] = grid.origin[a] - beside;
    window[a + 2] = grid.origin[a] + grid.pitch[a] * grid.ratio[a].maps_per_texel() * grid.texels[a] + beside;
  }
  const double far = grid.far_depth * (1 + kBehindFar);
  ConvexRegion region = LightSpread(face).hull(window, far);
  region.add({{0, 0, 1}, face.reach[2]});
  region.add({{0, 0, -1}, far});
  return region;
}

void keep_within(LightSpaceScene& scene, const ConvexRegion& region) {
  scene.triangles = 0;
  for (LightSpaceMesh& mesh : scene.meshes) {
    keep_within(mesh, region);
    scene.triangles += mesh.triangles.size();
  }
  std::erase_if(scene.meshes, [](const LightSpaceMesh& mesh) { return mesh.triangles.empty(); });
  const auto misses = [&](const auto& caster) { return lies_outside(caster.hull, region); };
  std::erase_if(scene.volumes, misses);
  std::erase_if(scene.curves, misses);
}

}  // namespace pdsm
