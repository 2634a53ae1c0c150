// SPDX-License-Identifier: Apache-2.0
#include "truth/volume_shadows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <tuple>

namespace pdsm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Places in t, sorted, where a ray crosses the lattice planes between `begin` and `end`.
class Crossings {
 public:
  Crossings(const glm::dvec3& origin, const glm::dvec3& direction, double begin, double end) {
    t_[count_++] = begin;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = origin[axis] + begin * direction[axis], b = origin[axis] + end * direction[axis];
      for (double plane = std::floor(std::min(a, b)) + 1; plane < std::max(a, b); ++plane)
        add((plane - origin[axis]) / direction[axis], begin, end);
    }
    std::sort(t_.begin() + 1, t_.begin() + count_);
    t_[count_++] = end;
  }
  [[nodiscard]] std::span<const double> all() const { return {t_.data(), static_cast<std::size_t>(count_)}; }

 private:
  void add(double t, double begin, double end) {
    if (t > begin && t < end) t_[static_cast<std::size_t>(count_++)] = t;
  }
  // A box has 9 planes an axis.
  std::array<double, 32> t_;
  std::ptrdiff_t count_ = 0;
};

double mix(double a, double b, double weight) {
  return a + weight * (b - a);
}

}  // namespace

/// In a volume's index coordinates.
struct VolumeShadows::Ray {
  glm::dvec3 origin, direction, inverse;
  double begin, end;

  [[nodiscard]] Way within(const glm::dvec3& low, const glm::dvec3& high) const {
    Way inside{begin, end};
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) {
        // Along a face, the ray is in one of the two boxes.
        if (origin[axis] < low[axis] || origin[axis] >= high[axis]) return {0, 0};
        continue;
      }
      const double a = (low[axis] - origin[axis]) * inverse[axis],
                   b = (high[axis] - origin[axis]) * inverse[axis];
      inside.begin = std::max(inside.begin, std::min(a, b));
      inside.end = std::min(inside.end, std::max(a, b));
    }
    return inside;
  }
};

/// Every lattice point with density goes to the cells around it.
std::vector<VolumeShadows::Box> VolumeShadows::make_boxes(const DensityGrid& grid) {
  std::map<std::tuple<int, int, int>, std::size_t> places;
  std::vector<Box> boxes;
  const auto box_at = [&](const glm::ivec3& first) -> Box& {
    const auto [known, fresh] = places.emplace(std::tuple(first.x, first.y, first.z), boxes.size());
    if (fresh) boxes.push_back({glm::dvec3(first), {}});
    return boxes[known->second];
  };
  for (const DensityBrick& brick : grid.bricks) {
    for (int n = 0; n < kEdge * kEdge * kEdge; ++n) {
      const float density = brick.density[static_cast<std::size_t>(n)];
      if (density == 0) continue;
      const std::array<int, 3> at{n % kEdge, n / kEdge % kEdge, n / (kEdge * kEdge)};
      // A point on the first plane of a box is on the last one of the box before.
      for (int beside = 0; beside < 8; ++beside) {
        const glm::ivec3 back(beside & 1, beside / 2 & 1, beside / 4);
        if ((back.x == 1 && at[0] > 0) || (back.y == 1 && at[1] > 0) || (back.z == 1 && at[2] > 0)) continue;
        const auto along = [&](int axis) {
          return static_cast<std::size_t>(at[static_cast<std::size_t>(axis)] + back[axis] * kEdge);
        };
        box_at(brick.first - back * kEdge).corner[along(2)][along(1)][along(0)] =
            static_cast<double>(density);
      }
    }
  }
  return boxes;
}

/// Halves along the longest side. Returns the number of the node.
std::uint32_t VolumeShadows::make_nodes(Tree& tree, std::uint32_t first, std::uint32_t count) {
  const auto number = static_cast<std::uint32_t>(tree.nodes.size());
  Node node{glm::dvec3(kInfinity), glm::dvec3(-kInfinity), first, count, 0};
  const std::span<Box> boxes(tree.boxes.data() + first, count);
  for (const Box& box : boxes) {
    node.low = glm::min(node.low, box.first);
    node.high = glm::max(node.high, box.first + double{kEdge});
  }
  tree.nodes.push_back(node);
  if (count == 1) return number;
  const glm::dvec3 size = node.high - node.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::ranges::nth_element(boxes, boxes.begin() + count / 2,
                           [axis](const Box& a, const Box& b) { return a.first[axis] < b.first[axis]; });
  make_nodes(tree, first, count / 2);
  const std::uint32_t second = make_nodes(tree, first + count / 2, count - count / 2);
  tree.nodes[number].second_half = second;
  return number;
}

VolumeShadows::VolumeShadows(const Scene& scene) {
  for (const Volume& volume : scene.volumes) {
    check_volume(volume);
    if (!casts_shadows(volume)) continue;
    Tree tree{glm::inverse(volume.index_to_world), volume.extinction, make_boxes(*volume.grid), {}};
    if (tree.boxes.empty()) continue;
    make_nodes(tree, 0, static_cast<std::uint32_t>(tree.boxes.size()));
    volumes_.push_back(std::move(tree));
  }
}

/// By Simpson's rule in each cell, where density is a cubic along the ray: exact.
double VolumeShadows::integral(const Box& box, const Ray& ray, double begin, double end) {
  const glm::dvec3 origin = ray.origin - box.first;
  const Crossings crossings(origin, ray.direction, begin, end);
  double sum = 0;
  for (std::size_t n = 0; n + 1 < crossings.all().size(); ++n) {
    const double a = crossings.all()[n], b = crossings.all()[n + 1];
    const glm::dvec3 middle = origin + 0.5 * (a + b) * ray.direction;
    const glm::dvec3 cell = glm::clamp(glm::floor(middle), 0.0, double{kEdge - 1});
    const auto density = [&](double t) {
      const glm::dvec3 w = glm::clamp(origin + t * ray.direction - cell, 0.0, 1.0);
      const auto x = static_cast<std::size_t>(cell.x), y = static_cast<std::size_t>(cell.y),
                 z = static_cast<std::size_t>(cell.z);
      const auto& c = box.corner;
      const double lower =
          mix(mix(c[z][y][x], c[z][y][x + 1], w.x), mix(c[z][y + 1][x], c[z][y + 1][x + 1], w.x), w.y);
      const double upper = mix(mix(c[z + 1][y][x], c[z + 1][y][x + 1], w.x),
                               mix(c[z + 1][y + 1][x], c[z + 1][y + 1][x + 1], w.x), w.y);
      return mix(lower, upper, w.z);
    };
    sum += (b - a) / 6 * (density(a) + 4 * density(0.5 * (a + b)) + density(b));
  }
  return sum;
}

double VolumeShadows::integral(const Tree& tree, const Ray& ray) {
  double sum = 0;
  std::array<std::uint32_t, 64> waiting;
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const std::uint32_t number = waiting[--count];
    const Node& node = tree.nodes[number];
    const Way inside = ray.within(node.low, node.high);
    if (!(inside.begin < inside.end)) continue;
    if (node.count == 1) {
      sum += integral(tree.boxes[node.first], ray, inside.begin, inside.end);
    } else {
      waiting[count++] = number + 1;
      waiting[count++] = node.second_half;
    }
  }
  return sum;
}

VolumeShadows::Ray VolumeShadows::ray_in(const Tree& tree, const glm::dvec3& from, const glm::dvec3& along,
                                         double begin, double end) {
  const glm::dvec3 direction = glm::dmat3(tree.world_to_index) * along;
  return {glm::dvec3(tree.world_to_index * glm::dvec4(from, 1.0)), direction, 1.0 / direction, begin, end};
}

VolumeShadows::Way VolumeShadows::way(const glm::dvec3& from, const glm::dvec3& along, double begin,
                                      double end) const {
  Way all{end, begin};
  for (const Tree& tree : volumes_) {
    const Way one = ray_in(tree, from, along, begin, end).within(tree.nodes[0].low, tree.nodes[0].high);
    if (one.begin < one.end) all = {std::min(all.begin, one.begin), std::max(all.end, one.end)};
  }
  return all;
}

double VolumeShadows::share_left(const glm::dvec3& from, const glm::dvec3& along, double begin,
                                 double end) const {
  double optical_depth = 0;
  for (const Tree& tree : volumes_)
    optical_depth +=
        tree.extinction * glm::length(along) * integral(tree, ray_in(tree, from, along, begin, end));
  return std::exp(-optical_depth);
}

}  // namespace pdsm
