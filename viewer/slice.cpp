// SPDX-License-Identifier: Apache-2.0
#include "slice.h"

#include <array>

namespace pdsm {
namespace {

/// Half the edge of a plane across a world axis, radii of the focus. The window cuts it.
constexpr double kReach = 3.0;
/// Part of the scene that such a plane moves through, radii of the focus to both sides.
constexpr double kTravel = 1.25;

/// A parallelogram, metres from the origin.
struct Plane {
  glm::vec3 corner, edge_a, edge_b;
};

Plane world_plane(const Stage& stage, const Settings& settings, double place) {
  const int axis = static_cast<int>(settings.slice_axis);
  glm::dvec3 centre = stage.origin(), a(0), b(0);
  centre[axis] = place;
  a[(axis + 1) % 3] = b[(axis + 2) % 3] = kReach * stage.focus().radius;
  return {stage.local(centre - a - b), glm::vec3(2.0 * a), glm::vec3(2.0 * b)};
}

Plane depth_plane(const Stage& stage, const View& view, double depth) {
  const double reach = view.projection == Projection::perspective ? depth : 1;
  const RigidTransform to_world = inverse(view.world_to_view);
  const auto corner = [&](std::size_t x, std::size_t y) {
    return stage.local(apply(to_world, glm::dvec3(view.window[x] * reach, view.window[y] * reach, depth)));
  };
  const glm::vec3 low = corner(0, 1);
  return {low, corner(2, 1) - low, corner(0, 3) - low};
}

/// From metres of the GPU's origin to the view's space.
glm::mat4 to_view_space(const View& view, const glm::dvec3& origin) {
  const auto& r = view.world_to_view.rotation;
  glm::dmat4 matrix(1);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      matrix[column][row] = r[static_cast<std::size_t>(3 * row + column)];
  }
  matrix[3] = glm::dvec4(apply(view.world_to_view, origin), 1);
  return glm::mat4(matrix);
}

}  // namespace

double slice_place(const Stage& stage, const View& view, const Settings& settings) {
  const double share = settings.slice_position;
  if (settings.slice_axis == SliceAxis::depth) {
    return view.near_depth + share * (view.far_depth - view.near_depth);
  }
  const double centre = stage.origin()[static_cast<int>(settings.slice_axis)];
  return centre + (2 * share - 1) * kTravel * stage.focus().radius;
}

void Slice::draw(const ShaderProgram& program, const Stage& stage, const PenumbraMap& map, int index,
                 const Settings& settings) const {
  const View& view = map.views.front();
  const double place = slice_place(stage, view, settings);
  const Plane plane = settings.slice_axis == SliceAxis::depth ? depth_plane(stage, view, place)
                                                              : world_plane(stage, settings, place);
  program.use();
  program.set("corner", plane.corner);
  program.set("edge_a", plane.edge_a);
  program.set("edge_b", plane.edge_b);
  program.set("map", index);
  program.set("world_to_view", to_view_space(view, stage.origin()));
  program.set("window", glm::vec4(view.window[0], view.window[1], view.window[2], view.window[3]));
  program.set("depths", glm::vec2(view.near_depth, view.far_depth));
  program.set("slope", view.projection == Projection::perspective ? 1.0F : 0.0F);
  program.set("contours", settings.slice_contours ? 1.0F : 0.0F);
  glBindVertexArray(array_.name());
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  constexpr float kHidden = 0.18F;
  for (const auto& [comparison, opacity] :
       {std::pair<GLenum, float>{GL_GREATER, kHidden}, {GL_LEQUAL, 1.0F}}) {
    glDepthFunc(comparison);
    program.set("opacity", opacity);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

}  // namespace pdsm
