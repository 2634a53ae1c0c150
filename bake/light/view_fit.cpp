// SPDX-License-Identifier: Apache-2.0
//
// Fitting a view to the scene, in light space; "depth" is z. light_spread.h has the maths of windows and
// lights.
#include "pdsm/bake/view_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "light/convex_clip.h"
#include "light/fit_face.h"
#include "light/light_faces.h"
#include "light/light_geometry.h"
#include "light/light_in_hull.h"
#include "light/light_spread.h"
#include "pdsm/format/error.h"
#include "scene/caster_hull.h"

namespace pdsm {
namespace {

// A fitted window is at most 120 degrees wide.
constexpr double kMaxTangent = std::numbers::sqrt3;
// Casters nearer than this fraction of far do not count: they lie in the emitter's plane as good as,
// and a near of 0 has no perspective. Also the depth that geometry may reach behind a surface that is
// taken for the scene's outer boundary.
constexpr double kEmitterSkin = 1e-4;
// A view that the light reaches into in depth begins at so many times that reach: walks grow as the inverse
// of what is between samples and near.
constexpr double kNearByReach = 2;
// Relative room between near, far and the surfaces they are fitted to, so that rounding to float does
// not put those outside.
constexpr double kDepthPad = 1e-6;
// Relative room between the window and the outermost shadow.
constexpr double kWindowPad = 1e-6;
// A window narrower than this share of what it sees (so, in tangents) is widened to it: a receiver seen
// edge-on has none at all.
constexpr double kMinWindowSize = 1e-4;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr Window kWidestWindow{-kMaxTangent, -kMaxTangent, kMaxTangent, kMaxTangent};
constexpr Window kUnboundedWindow{-kInfinity, -kInfinity, kInfinity, kInfinity};
// For a light in front of which there is nothing at all.
constexpr Window kDefaultWindow{-1, -1, 1, 1};
constexpr double kDefaultFar = 1;

/// A box of window coordinates that grows.
struct WindowBounds {
  Window box{kInfinity, kInfinity, -kInfinity, -kInfinity};

  [[nodiscard]] bool empty() const { return !(box[0] <= box[2] && box[1] <= box[3]); }
  void include(const Window& other) {
    box = {std::min(box[0], other[0]), std::min(box[1], other[1]), std::max(box[2], other[2]),
           std::max(box[3], other[3])};
  }
  [[nodiscard]] bool contains(const Window& other) const {
    return box[0] <= other[0] && box[1] <= other[1] && box[2] >= other[2] && box[3] >= other[3];
  }
  void intersect(const Window& other) {
    box = {std::max(box[0], other[0]), std::max(box[1], other[1]), std::min(box[2], other[2]),
           std::min(box[3], other[3])};
  }
};

/// What can be darkened: where it is seen, how deep it reaches, and the box around it.
struct ReceiverBounds {
  WindowBounds places;
  bool of_casters = false;                      ///< nothing receives: what casts is taken
  double depth = 0;                             ///< of the deepest, 0 when there is none
  glm::dvec3 low{kInfinity}, high{-kInfinity};  ///< in world axes about the light's centre

  void include(const LightSpace& space, const LightSpread& spread, const glm::dvec3& p) {
    // The pyramid's apex has no slope.
    if (!(p.z > 0)) return;
    const auto [x, y] = spread.place(p);
    places.include({x, y, x, y});
    depth = std::max(depth, p.z);
    const glm::dvec3 w = space.to_world_axes(p);
    low = glm::min(low, w);
    high = glm::max(high, w);
  }
};

/// Vertices of one geometry after the other: those of a mesh are each shared by about six triangles.
class VertexSet {
 public:
  [[nodiscard]] bool has_all(const Geometry& geometry, const glm::uvec3& vertices) {
    if (geometry_ != &geometry) {
      geometry_ = &geometry;
      has_.assign(geometry.mesh->positions.size(), 0);
    }
    return has_[vertices.x] != 0 && has_[vertices.y] != 0 && has_[vertices.z] != 0;
  }
  /// Of the geometry that has_all() was asked about last.
  void add(const glm::uvec3& vertices) { has_[vertices.x] = has_[vertices.y] = has_[vertices.z] = 1; }

 private:
  const Geometry* geometry_ = nullptr;
  std::vector<std::uint8_t> has_;
};

enum class Role { receiver, caster };

bool has_role(const Geometry& geometry, Role role) {
  return geometry.mesh && (role == Role::caster ? casts_shadows(geometry) : geometry.receives);
}

/// Cuts `region` to depths from z0 to z1.
void limit_depth(ConvexRegion& region, double z0, double z1) {
  region.add({{0, 0, 1}, -z0});
  region.add({{0, 0, -1}, z1});
}

/// Calls visit(polygon) with the part of the triangle inside `region`, if there is one.
template <typename Visit>
void visit_inside(const LightTriangle& triangle, const ConvexRegion& region, Visit&& visit) {
  if (triangle.outside_all != 0) return;
  const auto& c = triangle.corners;
  if (triangle.outside_any == 0) {
    visit(std::span<const glm::dvec3>(c));
    return;
  }
  const SmallPolygon part = clip({c[0], c[1], c[2]}, region, triangle.outside_any);
  if (!part.corners().empty()) visit(part.corners());
}

/// One light and one scene while a view is fitted.
class ViewFitter {
 public:
  ViewFitter(const Scene& scene, const LightFace& face)
      : scene_(scene),
        face_(face),
        light_(face.light),
        space_(face.light),
        spread_(face),
        hulls_(caster_hulls(scene)) {}

  [[nodiscard]] FittedView fit() const;

 private:
  template <typename Visit>
  void visit_geometry(Role role, Visit&& visit) const;
  template <typename Visit>
  void visit_parts(Role role, const ConvexRegion& region, Visit&& visit) const;
  [[nodiscard]] bool faces_light(const Geometry& geometry, const LightTriangle& triangle) const;
  [[nodiscard]] ReceiverBounds receiver_bounds(const Window& window) const;
  [[nodiscard]] Window fit_window(const ReceiverBounds& receivers) const;
  [[nodiscard]] double nearest_caster(const Window& window, double deepest, double far) const;
  [[nodiscard]] double share_outside(const Window& window) const;
  [[nodiscard]] Window widest_window() const { return spread_.distant() ? kUnboundedWindow : kWidestWindow; }
  /// Depth up to which geometry is the emitter, in a scene as deep as `deepest`: none before a distant light.
  [[nodiscard]] double emitter_depth(double deepest) const {
    if (face_.reach[2] > 0) return -face_.reach[2];
    return spread_.distant() ? -kInfinity : kEmitterSkin * deepest;
  }
  [[nodiscard]] double fit_near(double nearest, const FittedView& fitted) const;
  [[nodiscard]] Window pad_window(Window window, double deepest) const;

  /// Whether light may begin in a hull: then no surface tells where that begins to cast.
  [[nodiscard]] bool hull_holds_light(double deepest) const {
    return std::ranges::any_of(
        hulls_, [&](const CasterHull& hull) { return may_hold_light(hull, face_, emitter_depth(deepest)); });
  }

  const Scene& scene_;
  const LightFace& face_;
  const Light& light_;
  LightSpace space_;
  LightSpread spread_;
  std::vector<CasterHull> hulls_;  ///< casters
};

/// Whether light from any point of the emitter can arrive at the front of the triangle; open meshes have
/// no back.
bool ViewFitter::faces_light(const Geometry& geometry, const LightTriangle& triangle) const {
  return !geometry.mesh->closed || spread_.reaches_front(triangle.corners);
}

template <typename Visit>
void ViewFitter::visit_geometry(Role role, Visit&& visit) const {
  for (const Geometry& geometry : scene_.geometry)
    if (has_role(geometry, role)) visit(geometry);
  for (const CasterHull& hull : hulls_)
    if (has_role(hull.surface, role)) visit(hull.surface);
}

/// Calls visit(geometry, triangle, polygon) for the part inside `region` of each triangle of that role.
template <typename Visit>
void ViewFitter::visit_parts(Role role, const ConvexRegion& region, Visit&& visit) const {
  visit_geometry(role, [&](const Geometry& geometry) {
    space_.visit_triangles(geometry, region, [&](const LightTriangle& triangle) {
      visit_inside(triangle, region,
                   [&](std::span<const glm::dvec3> part) { visit(geometry, triangle, part); });
    });
  });
}

/// What is seen through `window`: the receivers, or the casters when nothing receives there.
ReceiverBounds ViewFitter::receiver_bounds(const Window& window) const {
  ConvexRegion region = spread_.pyramid(window);
  limit_depth(region, 0, light_.far_depth.value_or(std::numeric_limits<double>::max()));
  for (const Role role : {Role::receiver, Role::caster}) {
    ReceiverBounds bounds;
    bounds.of_casters = role == Role::caster;
    VertexSet included;
    visit_parts(
        role, region,
        [&](const Geometry& geometry, const LightTriangle& triangle, std::span<const glm::dvec3> part) {
          const bool is_whole = triangle.outside_any == 0;
          if (is_whole && included.has_all(geometry, triangle.vertices)) return;
          if (role == Role::receiver && !faces_light(geometry, triangle)) return;
          if (is_whole) included.add(triangle.vertices);
          for (const glm::dvec3& p : part) bounds.include(space_, spread_, p);
        });
    if (bounds.depth > 0) return bounds;
  }
  return {};
}

/// Whether all of `points` lie on one side of the triangle's plane, but for `tolerance`. A triangle that has
/// the whole light and all receivers on one side blocks nothing: floors, walls, the sky.
bool on_one_side(const std::array<glm::dvec3, 3>& triangle, std::span<const glm::dvec3> points,
                 double tolerance) {
  const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  const double slack = tolerance * glm::length(normal);
  double low = kInfinity, high = -kInfinity;
  for (const glm::dvec3& p : points) {
    const double distance = glm::dot(normal, p - triangle[0]);
    low = std::min(low, distance);
    high = std::max(high, distance);
  }
  return low >= -slack || high <= slack;
}

/// Widens a window by its pad and to its least size, and cuts it to the widest.
Window ViewFitter::pad_window(Window window, double deepest) const {
  const Window widest = widest_window();
  const double least_size = kMinWindowSize * (spread_.distant() ? deepest : 1);
  for (std::size_t i = 0; i < 2; ++i) {
    const double centre = (window[i] + window[i + 2]) / 2, half = (window[i + 2] - window[i]) / 2;
    // The second term is for rounding when the window is small and far off the axis.
    const double pad = kWindowPad * (half + 1e-3 * std::abs(centre));
    const double padded = std::max(half + pad, least_size / 2);
    window[i] = std::max(centre - padded, widest[i]);
    window[i + 2] = std::min(centre + padded, widest[i + 2]);
  }
  return window;
}

/// Where a caster can darken a receiver; the receivers' own places when there are none.
Window ViewFitter::fit_window(const ReceiverBounds& receivers) const {
  if (receivers.places.empty()) return kDefaultWindow;
  const double deepest = receivers.depth, tolerance = kEmitterSkin * deepest;
  if (hull_holds_light(deepest)) return pad_window(receivers.places.box, deepest);
  ConvexRegion region = spread_.hull(receivers.places.box, deepest);
  limit_depth(region, emitter_depth(deepest), deepest * (1 - kDepthPad));

  // The emitter and the receivers' box: what must lie on both sides of a triangle for it to block.
  std::array<glm::dvec3, 12> probes;
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1U) ? receivers.high.x : receivers.low.x,
                            (i & 2U) ? receivers.high.y : receivers.low.y,
                            (i & 4U) ? receivers.high.z : receivers.low.z);
    probes[i] = space_.from_world_axes(corner);
  }
  std::ranges::copy(spread_.corners(receivers.places.box, deepest), probes.begin() + 8);

  WindowBounds shadows;
  visit_parts(Role::caster, region,
              [&](const Geometry&, const LightTriangle& triangle, std::span<const glm::dvec3> part) {
                WindowBounds own;
                for (const glm::dvec3& p : part) own.include(spread_.shadow(p, deepest));
                // The test of sides is only for the few triangles that would make the window larger.
                if (shadows.contains(own.box) || on_one_side(triangle.corners, probes, tolerance)) return;
                shadows.include(own.box);
              });
  shadows.intersect(receivers.places.box);
  return pad_window(shadows.empty() ? receivers.places.box : shadows.box, deepest);
}

/// Depth of the nearest caster in the hull of light and window, in front of the deepest receiver; infinity
/// if there is none.
double ViewFitter::nearest_caster(const Window& window, double deepest, double far) const {
  ConvexRegion region = spread_.hull(window, far);
  limit_depth(region, emitter_depth(far), deepest * (1 - kDepthPad));
  double nearest = hull_holds_light(far) ? emitter_depth(far) : kInfinity;
  visit_geometry(Role::caster, [&](const Geometry& geometry) {
    space_.visit_triangles(geometry, region, [&](const LightTriangle& triangle) {
      const auto& c = triangle.corners;
      if (std::min({c[0].z, c[1].z, c[2].z}) >= nearest) return;
      visit_inside(triangle, region, [&](std::span<const glm::dvec3> part) {
        for (const glm::dvec3& p : part) nearest = std::min(nearest, p.z);
      });
    });
  });
  return nearest;
}

/// Share, by area, of the light-facing receivers in front of the light that lies outside `window`.
double ViewFitter::share_outside(const Window& window) const {
  ConvexRegion region = spread_.pyramid(window);
  region.add({{0, 0, 1}, 0});
  const std::uint32_t behind = 1U << (region.half_spaces().size() - 1);
  double total = 0, inside = 0;
  for (const Geometry& geometry : scene_.geometry) {
    if (!has_role(geometry, Role::receiver)) continue;
    space_.visit_triangles(geometry, region, [&](const LightTriangle& triangle) {
      const auto& c = triangle.corners;
      if (!(std::max({c[0].z, c[1].z, c[2].z}) > 0) || !faces_light(geometry, triangle)) return;
      const bool crosses = (triangle.outside_any & behind) != 0;
      const double in_front = crosses ? area(clip({c[0], c[1], c[2]}, region, behind).corners()) : area(c);
      total += in_front;
      if (triangle.outside_any == 0) {
        inside += in_front;
        return;
      }
      visit_inside(triangle, region, [&](std::span<const glm::dvec3> part) { inside += area(part); });
    });
  }
  return total > 0 ? std::clamp(1 - inside / total, 0.0, 1.0) : 0.0;
}

/// The nearest caster's depth, but no nearer than the light leaves room for.
double ViewFitter::fit_near(double nearest, const FittedView& fitted) const {
  const double far = fitted.view.far_depth, least = kNearByReach * face_.reach[2];
  if (!(least > 0)) {
    // Without casters any near is right; one that is not tiny keeps the projection well-conditioned.
    const double fitted_near = fitted.nothing_casts ? far / 2 : nearest * (1 - kDepthPad);
    return std::max(fitted_near, emitter_depth(far));
  }
  return std::max({least, kEmitterSkin * far, fitted.nothing_casts ? far / 2 : nearest * (1 - kDepthPad)});
}

FittedView ViewFitter::fit() const {
  FittedView fitted;
  View& view = fitted.view;
  view.world_to_view = light_frame(light_);
  view.projection = spread_.distant() ? Projection::orthographic : Projection::perspective;
  ReceiverBounds receivers = receiver_bounds(light_.window.value_or(widest_window()));
  fitted.window_fitted = !light_.window;
  view.window = light_.window ? *light_.window : fit_window(receivers);
  if (fitted.window_fitted) receivers = receiver_bounds(view.window);

  fitted.nothing_receives = receivers.of_casters || !(receivers.depth > 0);

  fitted.far_fitted = !light_.far_depth;
  double deepest = light_.far_depth.value_or(receivers.depth);
  if (!(deepest > 0)) deepest = light_.near_depth ? 2 * *light_.near_depth : kDefaultFar;
  view.far_depth = light_.far_depth ? *light_.far_depth : deepest * (1 + kDepthPad);

  fitted.near_fitted = !light_.near_depth;
  const double nearest = nearest_caster(view.window, deepest, view.far_depth);
  fitted.nothing_casts = nearest == kInfinity;
  if (!(nearest > 0) && spread_.distant()) {
    throw Error(Failure::input, light_.name + ".position",
                "a distant light's space must begin in front of its casters: see place_distant_light()");
  }
  view.near_depth = light_.near_depth ? *light_.near_depth : fit_near(nearest, fitted);
  if (face_.is_of_cube) {
    fitted.casts_before_near = nearest < view.near_depth * (1 - 2 * kDepthPad);
    // A view that nothing lies in behind its near has nothing to tell, but needs a depth.
    if (fitted.far_fitted) view.far_depth = std::max(view.far_depth, kNearByReach * view.near_depth);
    return fitted;
  }
  fitted.receivers_outside = share_outside(view.window);
  return fitted;
}

/// Refuses what a host program or a scene file may have asked for and cannot have.
void check_request(const Light& light) {
  const auto refuse = [&](const char* field, const char* reason) {
    throw Error(Failure::input, light.name + "." + field, reason);
  };
  if (const auto* sun = std::get_if<DistantLight>(&light.shape)) {
    if (!(sun->angle >= 0 && sun->angle <= kMostDistantAngle))
      refuse("angle", "must be from 0 to 90 degrees");
  }
  if (light.near_depth && !(*light.near_depth > 0 && std::isfinite(*light.near_depth))) {
    refuse("near", "must be a number > 0");
  }
  if (light.far_depth && !(*light.far_depth > 0 && std::isfinite(*light.far_depth))) {
    refuse("far", "must be a number > 0");
  }
  check_emission(light);
  if (!light.window) return;
  const Window& w = *light.window;
  const bool finite = std::ranges::all_of(w, [](double t) { return std::isfinite(t); });
  if (!finite || !(w[0] < w[2]) || !(w[1] < w[3]))
    refuse("window", "must be [x0,y0,x1,y1] with x0 < x1, y0 < y1");
}

}  // namespace

FittedView fit_face(const Scene& scene, const LightFace& face) {
  const Light& light = face.light;
  check_request(light);
  FittedView fitted = ViewFitter(scene, face).fit();
  const View& view = fitted.view;
  if (!(view.near_depth > face.reach[2]))
    throw Error(Failure::input, light.name + ".near",
                fmt::format("must be more than the light's own extent ({:.6g} m)", face.reach[2]));
  if (!(view.near_depth < view.far_depth)) {
    const char* origin = fitted.far_fitted ? ", the farthest receiver" : "";
    throw Error(Failure::input, light.name + ".near",
                fmt::format("must be less than far ({:.6g}{})", view.far_depth, origin));
  }
  fitted.view.width = face.width;
  fitted.view.height = face.height;
  return fitted;
}

FittedView fit_view(const Scene& scene, const Light& light, std::uint32_t width, std::uint32_t height) {
  return fit_face(scene, light_face(light, 0, width, height));
}

}  // namespace pdsm
