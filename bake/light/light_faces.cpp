// SPDX-License-Identifier: Apache-2.0
#include "light/light_faces.h"

#include <algorithm>
#include <cassert>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Texels along an edge below which seams are no longer narrow against the faces.
constexpr std::uint32_t kLeastFaceTexels = 8;
/// Share of the light's size that geometry may lie before its plane and still be the emitter.
constexpr double kEmitterShareOfLight = 1e-4;

/// The view that looks along -z.
constexpr std::uint32_t kBackFace = 5;

/// The axes of each view in those of the first, as columns x, y, z.
glm::dmat3 face_axes(std::uint32_t index) {
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const std::array<glm::dmat3, 6> axes{glm::dmat3(x, y, z),  glm::dmat3(y, z, x),  glm::dmat3(-y, z, -x),
                                       glm::dmat3(-x, z, y), glm::dmat3(x, z, -y), glm::dmat3(-x, y, -z)};
  return axes[index];
}

/// Whether the views are those of a cube or a half of one.
bool has_cube(const Light& light) {
  return view_count(light) > 2;
}

void check_faces(const Light& light, std::uint32_t width, std::uint32_t height) {
  const auto refuse = [&](const char* field, const char* reason) {
    throw Error(Failure::input, light.name + "." + field, reason);
  };
  const bool is_planar = !is_body(light) && !is_distant(light);
  if (light.two_sided && !is_planar) refuse("two_sided", "must be of a planar light");
  if (is_planar && light.two_sided && light.faces != 1 && light.faces != 6)
    refuse("faces", "must be 1 or 6 for two-sided lights");
  if (is_planar && !light.two_sided && light.faces != 1 && light.faces != 5)
    refuse("faces", "must be 1 or 5 for planar lights");
  if (is_distant(light) && light.faces != 1) refuse("faces", "must be 1 for distant lights");
  if (!has_cube(light)) return;
  if (light.window) refuse("window", "must not be given together with several faces");
  if (std::min(width, height) < kLeastFaceTexels)
    throw Error(Failure::usage, "--resolution", "must be at least 8 texels for a light of several faces");
}

/// Turns the light to look along a face's z axis.
void turn(const glm::dmat3& axes, Light& light) {
  const auto r = light_frame(light).rotation;
  const glm::dmat3 to_world(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]);
  light.direction = to_world * axes[2];
  light.up = to_world * axes[1];
}

}  // namespace

double LightFace::emitter_skin() const {
  return kEmitterShareOfLight * 2 * std::max({reach[0], reach[1], reach[2]});
}

std::array<double, 3> LightFace::from_light(const std::array<double, 3>& p) const {
  // Adding 0 turns -0 into 0.
  const glm::dvec3 q = glm::dvec3(p[0], p[1], p[2]) * to_light + 0.0;
  return {q.x, q.y, q.z};
}

LightFace light_face(const Light& light, std::uint32_t index, std::uint32_t width, std::uint32_t height) {
  assert(index < std::max(1U, view_count(light)));
  check_mesh_light(light);
  check_faces(light, width, height);
  const std::array<double, 3> reach = half_box(light);
  LightFace face{light, reach, glm::dmat3(1.0), width, height, view_count(light) > 1, has_cube(light), {}};
  if (!face.is_one_of_several) return face;
  const double texel_x = 2.0 / (width - 2), texel_y = 2.0 / (height - 2);
  if (face.is_of_cube) face.light.window = {-1 - texel_x, -1 - texel_y, 1 + texel_x, 1 + texel_y};
  if (index == 0) return face;
  face.to_light = face_axes(face.is_of_cube ? index : kBackFace);
  const glm::dvec3 turned = glm::abs(glm::dvec3(reach[0], reach[1], reach[2]) * face.to_light);
  face.reach = {turned.x, turned.y, turned.z};
  turn(face.to_light, face.light);
  if (is_body(light) || light.two_sided) return face;
  face.front = glm::dvec3(0, 0, 1) * face.to_light;
  // The upper half, and the seam below it.
  face.height = (height + 1) / 2 + 1;
  (*face.light.window)[1] = -texel_y;
  (*face.light.window)[3] = (face.height - 1) * texel_y;
  return face;
}

}  // namespace pdsm
