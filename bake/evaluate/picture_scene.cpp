// SPDX-License-Identifier: Apache-2.0
#include "evaluate/picture_scene.h"

#include <limits>
#include <map>

#include "evaluate/smooth_normals.h"

namespace pdsm {
namespace {

RTCRay make_ray(const glm::vec3& origin, const glm::vec3& direction, float end) {
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tfar = end;
  ray.mask = ~0U;
  return ray;
}

}  // namespace

PictureScene::PictureScene(const Scene& scene)
    : scene_(scene),
      world_(
          scene, [](const Geometry&) { return true; }, Holes::open, {}, [](const Curves&) { return true; }) {
  // Instances of one mesh share their normals.
  std::map<const Mesh*, std::shared_ptr<const CornerNormals>> known;
  for (const Geometry& geometry : scene.geometry) {
    auto& normals = known[geometry.mesh.get()];
    if (!normals) normals = std::make_shared<const CornerNormals>(smooth_normals(*geometry.mesh));
    normals_.push_back(normals);
  }
}

std::optional<SurfacePoint> PictureScene::trace(const glm::dvec3& origin, const glm::dvec3& direction) const {
  RTCRayHit query{};
  query.ray = make_ray(glm::vec3(origin - world_.centre()), glm::vec3(direction),
                       std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(world_.handle(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  if (query.hit.geomID >= scene_.geometry.size()) {
    const glm::vec3 across(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    const glm::vec3 normal = glm::normalize(across);
    const Curves& curves = scene_.curves[query.hit.geomID - scene_.geometry.size()];
    return SurfacePoint{origin + static_cast<double>(query.ray.tfar) * direction,
                        glm::dot(glm::dvec3(normal), direction) > 0 ? -normal : normal, curves.base_color,
                        curves.casts};
  }
  // The point comes from the triangle in doubles: it lies on the surface better than the ray's end.
  const Geometry& geometry = scene_.geometry[query.hit.geomID];
  const glm::uvec3& triangle = geometry.mesh->triangles[query.hit.primID];
  const auto& corner_normals = (*normals_[query.hit.geomID])[query.hit.primID];
  const glm::vec3 weights(1 - query.hit.u - query.hit.v, query.hit.u, query.hit.v);
  SurfacePoint point{glm::dvec3(0), glm::vec3(0), geometry.base_color, geometry.casts};
  glm::vec3 local_normal(0);
  for (int c = 0; c < 3; ++c) {
    point.position +=
        static_cast<double>(weights[c]) * to_world(geometry, geometry.mesh->positions[triangle[c]]);
    local_normal += weights[c] * corner_normals[static_cast<std::size_t>(c)];
  }
  const glm::dmat3 to_world_normal = glm::transpose(glm::inverse(glm::dmat3(geometry.local_to_world)));
  const glm::dvec3 normal = glm::normalize(to_world_normal * glm::dvec3(local_normal));
  point.normal = glm::vec3(glm::dot(normal, direction) > 0 ? -normal : normal);
  return point;
}

bool PictureScene::sees(const glm::dvec3& from, const glm::dvec3& to) const {
  constexpr float kShortOf = 0.999F;
  RTCRay ray = make_ray(glm::vec3(from - world_.centre()), glm::vec3(to - from), kShortOf);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(world_.handle(), &context, &ray);
  return ray.tfar >= 0;
}

}  // namespace pdsm
