// SPDX-License-Identifier: Apache-2.0
#include "gizmo.h"

#include <algorithm>
#include <array>

#include "evaluate/colour.h"
#include "light_outline.h"

namespace pdsm {
namespace {

constexpr glm::vec4 kOn{1.0F, 0.86F, 0.45F, 0.95F}, kOff{0.62F, 0.64F, 0.68F, 0.55F};
constexpr glm::vec4 kFrustum{0.45F, 0.78F, 1.0F, 0.55F};

/// A point of a view's space in the world: at depth z under the window's (x, y).
glm::dvec3 window_point(const View& view, double x, double y, double z) {
  const double reach = view.projection == Projection::perspective ? z : 1;
  return apply(inverse(view.world_to_view), glm::dvec3(x * reach, y * reach, z));
}

}  // namespace

void add_light_gizmo(LineBatch& lines, const Stage& stage, const Light& light, bool on) {
  const glm::vec4& colour = on ? kOn : kOff;
  std::vector<glm::vec3> outline;
  for (const glm::dvec3& point : light_outline(light, stage.focus())) outline.push_back(stage.local(point));
  lines.add_strip(outline, 2.5F, colour);

  const RigidTransform to_world = inverse(drawn_frame(light, stage.focus()));
  const std::array<double, 2> half = is_distant(light) ? std::array{0.0, 0.0} : half_extents(light);
  const double length = std::max(0.8 * std::max(half[0], half[1]), 0.15 * stage.focus().radius);
  const auto local = [&](double x, double y, double z) {
    return stage.local(apply(to_world, length * glm::dvec3(x, y, z)));
  };
  const glm::vec3 tip = local(0, 0, 1);
  lines.add(local(0, 0, 0), tip, 2.5F, colour);
  constexpr double kHead = 0.12, kBack = 0.78;
  for (const auto& [x, y] : {std::pair{kHead, 0.0}, {-kHead, 0.0}, {0.0, kHead}, {0.0, -kHead}}) {
    lines.add(tip, local(x, y, kBack), 2.5F, colour);
  }
}

void add_frustum(LineBatch& lines, const Stage& stage, const View& view) {
  const auto& w = view.window;
  std::array<std::vector<glm::vec3>, 2> rings;
  for (std::size_t end = 0; end < 2; ++end) {
    const double z = end == 0 ? view.near_depth : view.far_depth;
    for (const auto& [x, y] :
         {std::pair{w[0], w[1]}, {w[2], w[1]}, {w[2], w[3]}, {w[0], w[3]}, {w[0], w[1]}}) {
      rings[end].push_back(stage.local(window_point(view, x, y, z)));
    }
    lines.add_strip(rings[end], 1.5F, kFrustum);
  }
  for (std::size_t corner = 0; corner < 4; ++corner) {
    lines.add(rings[0][corner], rings[1][corner], 1.5F, kFrustum);
  }
}

void add_probe_ray(LineBatch& lines, const Stage& stage, const FunctionProbe& probe) {
  constexpr int kSteps = 96;
  const auto depth = [&](int i) {
    return probe.near_depth + (probe.far_depth - probe.near_depth) * i / kSteps;
  };
  const auto at = [&](double z) {
    return stage.local(apply(inverse(probe.world_to_view), z * probe.slope + probe.offset));
  };
  for (int i = 0; i < kSteps; ++i) {
    const double value = probe_value(probe, 0.5 * (depth(i) + depth(i + 1)));
    const glm::vec3 colour = heat_colour(value);
    lines.add(at(depth(i)), at(depth(i + 1)), 3.0F, glm::vec4(colour, 1));
  }
}

}  // namespace pdsm
