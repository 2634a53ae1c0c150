// SPDX-License-Identifier: Apache-2.0
//
// Fitting a view to the scene. Light space throughout: the light lies in z = 0 and has half extents h, a
// disk its bounding square; "depth" is z, "slope" is xy / z as seen from the light's centre.
//
// Window. A caster at P with depth z, seen from the point s of the light, throws its shadow at depth zr on
//     s + (P - s) zr / z,   so on the slope   P / z - s (1 / z - 1 / zr).
// Over all s and all depths from z to the deepest receiver zr that is, per axis,
//     [ (P - h) / z + h / zr,  (P + h) / z - h / zr ].
// Both ends are linear fractions of P, so over a triangle in front of the light they are found at corners.
//
// Near. What can block a point of the window's pyramid lies in the hull of the light and of the window at
// depth far: per axis, with window [w0, w1],
//     z w0 - h (1 - z / far)  <=  p  <=  z w1 + h (1 - z / far),
// linear in z, so four half-spaces.
#include "pdsm/bake/view_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "light/convex_clip.h"
#include "light/light_geometry.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

// A fitted window is at most 120 degrees wide.
constexpr double kMaxTangent = std::numbers::sqrt3;
// Casters nearer than this fraction of far do not count: they lie in the emitter's plane as good as,
// and a near of 0 has no perspective. Also the depth that geometry may reach behind a surface that is
// taken for the scene's outer boundary.
constexpr double kEmitterSkin = 1e-4;
// Relative room between near, far and the surfaces they are fitted to, so that rounding to float does
// not put those outside.
constexpr double kDepthPad = 1e-6;
// Relative room between the window and the outermost shadow.
constexpr double kWindowPad = 1e-6;
// A window narrower than this (in tangents) is widened to it: a receiver seen edge-on has none at all.
constexpr double kMinWindowSize = 1e-4;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Window = std::array<double, 4>;
constexpr Window kWidestWindow{-kMaxTangent, -kMaxTangent, kMaxTangent, kMaxTangent};
// For a light in front of which there is nothing at all.
constexpr Window kDefaultWindow{-1, -1, 1, 1};
constexpr double kDefaultFar = 1;

/// A box of slopes that grows.
struct SlopeBounds {
  Window box{kInfinity, kInfinity, -kInfinity, -kInfinity};

  [[nodiscard]] bool empty() const { return !(box[0] <= box[2] && box[1] <= box[3]); }
  void include(double x0, double y0, double x1, double y1) {
    box = {std::min(box[0], x0), std::min(box[1], y0), std::max(box[2], x1), std::max(box[3], y1)};
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
  SlopeBounds slopes;
  double depth = 0;                             ///< of the deepest, 0 when there is none
  glm::dvec3 low{kInfinity}, high{-kInfinity};  ///< in world axes about the light's centre

  void include(const LightSpace& space, const glm::dvec3& p) {
    // The pyramid's apex has no slope.
    if (!(p.z > 0)) return;
    const double x = p.x / p.z, y = p.y / p.z;
    slopes.include(x, y, x, y);
    depth = std::max(depth, p.z);
    const glm::dvec3 w = space.to_world_axes(p);
    low = glm::min(low, w);
    high = glm::max(high, w);
  }
};

enum class Role { receiver, caster };

bool has_role(const Geometry& geometry, Role role) {
  return geometry.mesh && (role == Role::caster ? geometry.casts : geometry.receives);
}

/// The hull of a light with half extents h and of `window` at depth `far`; the window's pyramid for h = 0.
ConvexRegion hull_of(const std::array<double, 2>& h, const Window& window, double far) {
  ConvexRegion region;
  for (int axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double spread = h[i] == 0 ? 0 : h[i] / far;
    glm::dvec3 low(0, 0, -window[i] - spread), high(0, 0, window[i + 2] - spread);
    low[axis] = 1;
    high[axis] = -1;
    region.add({low, h[i]});
    region.add({high, h[i]});
  }
  return region;
}

ConvexRegion pyramid_of(const Window& window) {
  return hull_of({0, 0}, window, kInfinity);
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
  ViewFitter(const Scene& scene, const Light& light)
      : scene_(scene), light_(light), space_(light), half_extents_(half_extents(light)) {}

  [[nodiscard]] FittedView fit() const;

 private:
  template <typename Visit>
  void visit_parts(Role role, const ConvexRegion& region, Visit&& visit) const;
  [[nodiscard]] bool faces_light(const Geometry& geometry, const LightTriangle& triangle) const;
  [[nodiscard]] ReceiverBounds receiver_bounds(const Window& window) const;
  [[nodiscard]] Window fit_window(const ReceiverBounds& receivers) const;
  [[nodiscard]] double nearest_caster(const Window& window, double deepest, double far) const;
  [[nodiscard]] double share_outside(const Window& window) const;
  [[nodiscard]] std::array<glm::dvec3, 4> light_corners() const;

  const Scene& scene_;
  const Light& light_;
  LightSpace space_;
  std::array<double, 2> half_extents_;
};

std::array<glm::dvec3, 4> ViewFitter::light_corners() const {
  const double x = half_extents_[0], y = half_extents_[1];
  return {glm::dvec3{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}};
}

/// Whether light from any point of the emitter can arrive at the front of the triangle; open meshes have
/// no back.
bool ViewFitter::faces_light(const Geometry& geometry, const LightTriangle& triangle) const {
  if (!geometry.mesh->closed) return true;
  const auto& c = triangle.corners;
  const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
  // The farthest that the emitter reaches along the normal, from the triangle's plane.
  const double reach = std::abs(normal.x) * half_extents_[0] + std::abs(normal.y) * half_extents_[1];
  return reach - glm::dot(normal, c[0]) > 0;
}

/// Calls visit(geometry, triangle, polygon) for the part inside `region` of each triangle of that role.
template <typename Visit>
void ViewFitter::visit_parts(Role role, const ConvexRegion& region, Visit&& visit) const {
  for (const Geometry& geometry : scene_.geometry) {
    if (!has_role(geometry, role)) continue;
    space_.visit_triangles(geometry, region, [&](const LightTriangle& triangle) {
      visit_inside(triangle, region,
                   [&](std::span<const glm::dvec3> part) { visit(geometry, triangle, part); });
    });
  }
}

/// What is seen through `window`: the receivers, or the casters when nothing receives there.
ReceiverBounds ViewFitter::receiver_bounds(const Window& window) const {
  ConvexRegion region = pyramid_of(window);
  limit_depth(region, 0, light_.far_depth.value_or(std::numeric_limits<double>::max()));
  for (const Role role : {Role::receiver, Role::caster}) {
    ReceiverBounds bounds;
    visit_parts(
        role, region,
        [&](const Geometry& geometry, const LightTriangle& triangle, std::span<const glm::dvec3> part) {
          if (role == Role::receiver && !faces_light(geometry, triangle)) return;
          for (const glm::dvec3& p : part) bounds.include(space_, p);
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
Window pad_window(Window window) {
  for (std::size_t i = 0; i < 2; ++i) {
    const double centre = (window[i] + window[i + 2]) / 2, half = (window[i + 2] - window[i]) / 2;
    // The second term is for rounding when the window is small and far off the axis.
    const double pad = kWindowPad * (half + 1e-3 * std::abs(centre));
    const double padded = std::max(half + pad, kMinWindowSize / 2);
    window[i] = std::max(centre - padded, -kMaxTangent);
    window[i + 2] = std::min(centre + padded, kMaxTangent);
  }
  return window;
}

/// The slopes under which a caster can darken a receiver; the receivers' own when there are none.
Window ViewFitter::fit_window(const ReceiverBounds& receivers) const {
  if (receivers.slopes.empty()) return kDefaultWindow;
  const double deepest = receivers.depth, tolerance = kEmitterSkin * deepest;
  ConvexRegion region = hull_of(half_extents_, receivers.slopes.box, deepest);
  limit_depth(region, kEmitterSkin * deepest, deepest * (1 - kDepthPad));

  // The emitter and the receivers' box: what must lie on both sides of a triangle for it to block.
  std::array<glm::dvec3, 12> probes;
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1U) ? receivers.high.x : receivers.low.x,
                            (i & 2U) ? receivers.high.y : receivers.low.y,
                            (i & 4U) ? receivers.high.z : receivers.low.z);
    probes[i] = space_.from_world_axes(corner);
  }
  std::ranges::copy(light_corners(), probes.begin() + 8);

  SlopeBounds shadows;
  const double hx = half_extents_[0], hy = half_extents_[1];
  visit_parts(Role::caster, region,
              [&](const Geometry&, const LightTriangle& triangle, std::span<const glm::dvec3> part) {
                SlopeBounds own;
                for (const glm::dvec3& p : part) {
                  own.include((p.x - hx) / p.z + hx / deepest, (p.y - hy) / p.z + hy / deepest,
                              (p.x + hx) / p.z - hx / deepest, (p.y + hy) / p.z - hy / deepest);
                }
                // The test of sides is only for the few triangles that would make the window larger.
                if (shadows.contains(own.box) || on_one_side(triangle.corners, probes, tolerance)) return;
                shadows.include(own.box[0], own.box[1], own.box[2], own.box[3]);
              });
  shadows.intersect(receivers.slopes.box);
  return pad_window(shadows.empty() ? receivers.slopes.box : shadows.box);
}

/// Depth of the nearest caster in the hull of light and window, in front of the deepest receiver; infinity
/// if there is none.
double ViewFitter::nearest_caster(const Window& window, double deepest, double far) const {
  ConvexRegion region = hull_of(half_extents_, window, far);
  limit_depth(region, kEmitterSkin * far, deepest * (1 - kDepthPad));
  double nearest = kInfinity;
  for (const Geometry& geometry : scene_.geometry) {
    if (!has_role(geometry, Role::caster)) continue;
    space_.visit_triangles(geometry, region, [&](const LightTriangle& triangle) {
      const auto& c = triangle.corners;
      if (std::min({c[0].z, c[1].z, c[2].z}) >= nearest) return;
      visit_inside(triangle, region, [&](std::span<const glm::dvec3> part) {
        for (const glm::dvec3& p : part) nearest = std::min(nearest, p.z);
      });
    });
  }
  return nearest;
}

/// Share, by area, of the light-facing receivers in front of the light that lies outside `window`.
double ViewFitter::share_outside(const Window& window) const {
  ConvexRegion region = pyramid_of(window);
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

FittedView ViewFitter::fit() const {
  FittedView fitted;
  View& view = fitted.view;
  view.world_to_view = light_frame(light_);
  ReceiverBounds receivers = receiver_bounds(light_.window.value_or(kWidestWindow));
  fitted.window_fitted = !light_.window;
  view.window = light_.window ? *light_.window : fit_window(receivers);
  if (fitted.window_fitted) receivers = receiver_bounds(view.window);

  fitted.far_fitted = !light_.far_depth;
  double deepest = light_.far_depth.value_or(receivers.depth);
  if (!(deepest > 0)) deepest = light_.near_depth ? 2 * *light_.near_depth : kDefaultFar;
  view.far_depth = light_.far_depth ? *light_.far_depth : deepest * (1 + kDepthPad);

  fitted.near_fitted = !light_.near_depth;
  const double nearest = nearest_caster(view.window, deepest, view.far_depth);
  fitted.nothing_casts = nearest == kInfinity;
  // Without casters any near is right; one that is not tiny keeps the projection well-conditioned.
  const double fitted_near = fitted.nothing_casts ? view.far_depth / 2 : nearest * (1 - kDepthPad);
  view.near_depth = light_.near_depth.value_or(std::max(fitted_near, kEmitterSkin * view.far_depth));
  fitted.receivers_outside = share_outside(view.window);
  return fitted;
}

/// Refuses what a host program or a scene file may have asked for and cannot have.
void check_request(const Light& light) {
  const auto refuse = [&](const char* field, const char* reason) {
    throw Error(Failure::input, light.name + "." + field, reason);
  };
  if (light.near_depth && !(*light.near_depth > 0 && std::isfinite(*light.near_depth))) {
    refuse("near", "must be a number > 0");
  }
  if (light.far_depth && !(*light.far_depth > 0 && std::isfinite(*light.far_depth))) {
    refuse("far", "must be a number > 0");
  }
  if (!light.window) return;
  const Window& w = *light.window;
  const bool finite = std::ranges::all_of(w, [](double t) { return std::isfinite(t); });
  if (!finite || !(w[0] < w[2]) || !(w[1] < w[3]))
    refuse("window", "must be [x0,y0,x1,y1] with x0 < x1, y0 < y1");
}

}  // namespace

FittedView fit_view(const Scene& scene, const Light& light, std::uint32_t width, std::uint32_t height) {
  check_request(light);
  FittedView fitted = ViewFitter(scene, light).fit();
  const View& view = fitted.view;
  if (!(view.near_depth < view.far_depth)) {
    const char* origin = fitted.far_fitted ? ", the farthest receiver" : "";
    throw Error(Failure::input, light.name + ".near",
                fmt::format("must be less than far ({:.6g}{})", view.far_depth, origin));
  }
  fitted.view.width = width;
  fitted.view.height = height;
  return fitted;
}

}  // namespace pdsm
