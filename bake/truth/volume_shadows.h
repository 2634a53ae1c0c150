// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// What a scene's volumes take of shadow rays. A ray's optical depth is a sum over the boxes of densities
/// that it meets, in whatever order; it has nothing in common with the baker's march. Any thread.
class VolumeShadows {
 public:
  /// Throws as check_volume() does.
  explicit VolumeShadows(const Scene& scene);

  [[nodiscard]] bool empty() const { return volumes_.empty(); }

  /// Where the ray from + t along, begin <= t <= end, may be in volumes; begin < end, or nowhere.
  struct Way {
    double begin, end;
  };
  [[nodiscard]] Way way(const glm::dvec3& from, const glm::dvec3& along, double begin, double end) const;

  /// The share of its light that is left to the ray from + t along between t = begin and end; in the world,
  /// metres.
  [[nodiscard]] double share_left(const glm::dvec3& from, const glm::dvec3& along, double begin,
                                  double end) const;

 private:
  static constexpr int kEdge = DensityBrick::kEdge, kCorners = kEdge + 1;
  /// The density of kEdge^3 cells from `first` on, by their corners.
  struct Box {
    glm::dvec3 first;
    std::array<std::array<std::array<double, kCorners>, kCorners>, kCorners> corner;  ///< [z][y][x]
  };
  /// A box around a run of boxes: its halves follow, unless it is one box.
  struct Node {
    glm::dvec3 low, high;
    std::uint32_t first = 0, count = 0;  ///< of boxes
    std::uint32_t second_half = 0;       ///< the first half is the next node
  };
  struct Tree {
    glm::dmat4 world_to_index{1.0};
    double extinction = 0;
    std::vector<Box> boxes;
    std::vector<Node> nodes;
  };
  struct Ray;

  static Ray ray_in(const Tree& tree, const glm::dvec3& from, const glm::dvec3& along, double begin,
                    double end);
  static std::vector<Box> make_boxes(const DensityGrid& grid);
  static std::uint32_t make_nodes(Tree& tree, std::uint32_t first, std::uint32_t count);
  static double integral(const Tree& tree, const Ray& ray);
  static double integral(const Box& box, const Ray& ray, double begin, double end);

  std::vector<Tree> volumes_;
};

}  // namespace pdsm
