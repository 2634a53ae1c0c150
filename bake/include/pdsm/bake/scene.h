// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "pdsm/bake/curves.h"
#include "pdsm/bake/volume.h"
#include "pdsm/format/penumbra_map.h"

/// A scene in memory: what casts, what receives, what lights. Right-handed, y up, metres, degrees. Plain
/// data; read from a scene file (scene_file.h) or filled by a host program. Read-only while baking, then
/// any thread may read it.
namespace pdsm {

/// How a mask goes on beyond its edges.
enum class MaskWrap : std::uint8_t { repeat, mirror, clamp };

/// What is cut out of a surface, as foliage, fences and grates are cut out of textures. The surface is there
/// where the mask's alpha is at least `cutoff`, and a hole elsewhere. Alpha is linear between texel centres,
/// which lie at ((i + 1/2) / width, (j + 1/2) / height).
struct CutoutMask {
  std::uint32_t width = 0, height = 0;  ///< texels, 1 .. kMostMaskTexels
  std::vector<std::uint8_t> alpha;      ///< row by row, the one at v = 0 first; 255 is 1
  std::array<MaskWrap, 2> wrap{};       ///< along u and v
  float cutoff = 0.5F;                  ///< 0 or more; 0: no holes, above 1: nothing but
  /// Nothing is cut out: alpha times Geometry::opacity is the surface's opacity, and the cutoff means
  /// nothing.
  bool blends = false;
  /// Where it blends: by what Geometry::transmission is multiplied in each texel, red, green and blue, in
  /// units of 1/255. Empty: 1 everywhere.
  std::vector<glm::u8vec3> transmission = {};
};
inline constexpr std::uint32_t kMostMaskTexels = 16384;

/// Indexed triangles in their own local space.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;  ///< indices into positions
  /// Every edge (after welding equal positions) is shared by two triangles of opposite direction: only
  /// then "light-facing" is told by the winding, else both sides count. See is_closed(). The winding counts
  /// as placed in the world, counter-clockwise seen from outside: a mirroring placement wants it turned over
  /// in local space, as importing a file does.
  bool closed = false;
  /// What is cut out; null: nothing. A mesh with a mask is never closed. Meshes may share masks.
  std::shared_ptr<const CutoutMask> mask;
  std::vector<glm::vec2> mask_places;  ///< (u, v) in the mask, one a position; none without a mask
};

/// Throws Error (input) "name:mask: reason" for a mask that is not as described above: sizes that don't fit,
/// a cutoff that is negative or NaN, a closed mesh. Baking calls it. O(1).
void check_mask(const Mesh& mesh, const std::string& name);

/// Whether the triangles form closed, consistently oriented surfaces; never with a mask. O(triangles).
[[nodiscard]] bool is_closed(const Mesh& mesh);

/// One placed mesh.
struct Geometry {
  std::string name;  ///< file, or file:node, for messages
  std::shared_ptr<const Mesh> mesh;
  glm::dmat4 local_to_world{1.0};
  bool casts = true, receives = true;
  /// Share of light that each surface takes away where a ray crosses it, 0 .. 1. Layers multiply. 0 casts
  /// nothing, 1 is opaque. With a mask that blends, times its alpha. What a translucent surface receives is
  /// what an opaque one does.
  double opacity = 1;
  /// Of what `opacity` takes away, the share that passes nevertheless, red, green and blue, 0 .. 1 each: the
  /// colour of stained glass. Where all three are 1, `opacity` takes nothing.
  glm::dvec3 transmission{0};
  glm::vec3 base_color{0.72F, 0.70F, 0.66F};  ///< linear RGB; pictures only
};

struct RectLight {
  double width = 1, height = 1;  ///< metres along light x and y; 0 makes a line or a point
};
struct DiskLight {
  double radius = 0.5;  ///< metres; 0 makes a point
};

/// Whether a geometry takes any light away.
[[nodiscard]] bool casts_shadows(const Geometry& geometry);

/// Whether it takes away a part of the light only, somewhere, of some channel.
[[nodiscard]] bool is_translucent_caster(const Geometry& geometry);

/// Whether it casts, and takes more of one channel than of another. O(texels of its mask).
[[nodiscard]] bool is_coloured_caster(const Geometry& geometry);

/// Throws Error (input) "name:opacity: reason", or of transmission, for one outside of 0 .. 1, or NaN. Baking
/// calls it.
void check_opacity(const Geometry& geometry);

/// A ball that emits from all of its surface: its map has the six faces of a cube as views.
struct SphereLight {
  double radius = 0.5;  ///< metres; 0 makes a point
};

/// Surfaces that emit, each part as much as it is large: outwards where they are closed, else to both sides.
/// The map has the six faces of a cube as views. The surfaces themselves cast nothing.
struct MeshLight {
  /// Metres about the light's position, along the light's axes; with an area. Masks count for nothing.
  std::shared_ptr<const Mesh> mesh;
};

/// A light so far away that it is seen under the same angle from everywhere: the sun.
struct DistantLight {
  double angle = 0.53;  ///< full angular diameter, degrees, 0 .. kMostDistantAngle; 0 makes hard shadows
};
/// A wider disk would be a sky: towards its rim, tangents and with them walks grow beyond all bounds.
inline constexpr double kMostDistantAngle = 90;

/// Where a light emits how much: a picture over its face, constant within each texel. Of a disk it covers the
/// bounding square. Only ratios matter.
struct EmissionImage {
  std::uint32_t width = 0, height = 0;  ///< texels, 1 .. kMostEmissionTexels
  std::vector<float> luminance;  ///< row by row along light x, the row at -y first; finite, >= 0, not all 0
  /// Linear red, green and blue of the same texels, finite, >= 0. Empty: as the luminance.
  std::vector<glm::vec3> colour = {};
};
inline constexpr std::uint32_t kMostEmissionTexels = 8192;

using LightShape = std::variant<RectLight, DiskLight, DistantLight, SphereLight, MeshLight>;

/// A planar area light, a distant one, a sphere, or a mesh.
struct Light {
  std::string name;  ///< [A-Za-z0-9_-]+, unique in the scene
  LightShape shape;
  /// Centre, metres. Of a distant light: where light space begins, in front of all geometry
  /// (place_distant_light()); near, far and window count from there, the light itself is nowhere.
  glm::dvec3 position{0};
  glm::dvec3 direction{0, -1, 0};  ///< any length > 0
  std::optional<glm::dvec3> up;    ///< default [0,1,0], or [0,0,1] within 1 degree of the direction
  /// [x0,y0,x1,y1], tangents (metres for a distant light); default fitted
  std::optional<std::array<double, 4>> window;
  std::optional<double> near_depth, far_depth;             ///< metres; default fitted
  std::optional<std::array<std::uint32_t, 2>> resolution;  ///< texels, width x height
  std::optional<std::uint32_t> samples;
  /// Whether a planar light shines to both sides of its plane.
  bool two_sided = false;
  /// Views of a planar light's map, a side: 1, or all that see what the light shines on: 5 (half a cube), of
  /// a two-sided one 6 in all (a cube). Sphere and mesh lights have 6, whatever this says. Cubes leave no
  /// choice of `window`.
  std::uint32_t faces = 1;
  std::shared_ptr<const EmissionImage> emission;  ///< of rect and disk lights; null: the same everywhere
};

/// Throws Error (input) "name.emission: reason" for what is not as described above. Baking calls it.
void check_emission(const Light& light);

/// Throws Error (input) "name.mesh: reason" for a mesh light without a mesh, with positions that are not
/// finite or indices beyond them, or without area; other lights pass. Baking calls it. O(triangles).
void check_mesh_light(const Light& light);

struct Scene {
  std::string source;  ///< path of the scene file, for messages; may be empty
  std::vector<Geometry> geometry;
  std::vector<Volume> volumes;
  std::vector<Curves> curves;
  std::vector<Light> lights;
  std::uint64_t content_hash = 0;  ///< XXH3 of scene file and all files it names, in order; 0 in memory
  std::vector<std::filesystem::path> files;  ///< that were read for it, in order, each once
  std::vector<std::string> warnings;
};

/// World to light space: z = direction, x = normalize(cross(up, z)), y = cross(z, x), origin at the
/// light's centre. Throws Error (input) on a zero direction or an explicit `up` parallel to it.
[[nodiscard]] RigidTransform light_frame(const Light& light);

/// p -> R p + t in double.
[[nodiscard]] inline glm::dvec3 apply(const RigidTransform& transform, const glm::dvec3& p) {
  const auto& r = transform.rotation;
  const auto& t = transform.translation;
  return {r[0] * p.x + r[1] * p.y + r[2] * p.z + t[0], r[3] * p.x + r[4] * p.y + r[5] * p.z + t[1],
          r[6] * p.x + r[7] * p.y + r[8] * p.z + t[2]};
}

/// The inverse motion.
[[nodiscard]] RigidTransform inverse(const RigidTransform& transform);

/// Whether the light's rays are parallel for each of its points.
[[nodiscard]] inline bool is_distant(const Light& light) {
  return std::holds_alternative<DistantLight>(light.shape);
}

[[nodiscard]] inline bool is_sphere(const Light& light) {
  return std::holds_alternative<SphereLight>(light.shape);
}

/// Whether the light is a body that shines to all sides: a sphere or a mesh.
[[nodiscard]] inline bool is_body(const Light& light) {
  return is_sphere(light) || std::holds_alternative<MeshLight>(light.shape);
}

/// Views of a light's map.
[[nodiscard]] inline std::uint32_t view_count(const Light& light) {
  if (is_body(light)) return 6;
  return light.two_sided && light.faces == 1 ? 2 : light.faces;
}

/// Moves the origin of a distant light's space in front of all that casts or receives: on the middle of
/// their bounds in light x and y, so that a scene far from the world's origin keeps its digits. Files'
/// lights have been placed by read_scene(); other lights stay where they are. Throws as light_frame().
void place_distant_light(const Scene& scene, Light& light);

/// Half extents of the light's shape along light x and y, metres; of a distant light, the tangent of half
/// its angle; of a mesh, of the box about the light's position that holds it.
[[nodiscard]] std::array<double, 2> half_extents(const Light& light);

/// The same along light x, y and z.
[[nodiscard]] std::array<double, 3> half_box(const Light& light);

/// Makes a light of these surfaces, in place of its shape: its position is the middle of their bounds, its
/// axes stay. Throws as light_frame(). They need a mesh each; whether they have an area is told by a bake.
void set_emitter(std::span<const Geometry> surfaces, Light& light);

}  // namespace pdsm
