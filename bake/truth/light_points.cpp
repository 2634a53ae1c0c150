// SPDX-License-Identifier: Apache-2.0
#include "truth/light_points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "truth/mesh_emitter.h"
#include "truth/random.h"

namespace pdsm {
namespace {

/// The unit square to the unit disk, ring by ring.
std::array<double, 2> concentric_disk(const std::array<double, 2>& unit) {
  const double a = 2 * unit[0] - 1, b = 2 * unit[1] - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool along_a = std::abs(a) > std::abs(b);
  const double radius = along_a ? a : b;
  const double angle =
      along_a ? std::numbers::pi / 4 * (b / a) : std::numbers::pi / 2 - std::numbers::pi / 4 * (a / b);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// The unit disk to the directions within half of `angle` (degrees) of the axis: cos t = 1 - r^2 (1 - cos T),
/// since by Archimedes a cap's area is its height.
glm::dvec3 cap_direction(double angle, const std::array<double, 2>& disk) {
  const double height = 1 - std::cos(angle / 2 * (std::numbers::pi / 180));
  const double squared = disk[0] * disk[0] + disk[1] * disk[1];
  if (!(squared > 0)) return {0, 0, 1};
  const double cosine = 1 - squared * height;
  const double scale = std::sqrt(height * (2 - squared * height)) / cosine;  // tan t / r
  return {disk[0] * scale, disk[1] * scale, 1};
}

struct Bin {
  std::size_t index = 0;
  double within = 0;
};

/// The last bin that begins at or before `unit` in [0, 1), and how far into it that is. Bins without a share
/// begin where the next one does, or at 1.
template <typename Iterator>
Bin find_bin(Iterator begin, Iterator end, double unit) {
  const Iterator after = std::upper_bound(begin, end, unit), bin = std::prev(after);
  const double close = after == end ? 1 : *after;
  return {static_cast<std::size_t>(bin - begin), (unit - *bin) / (close - *bin)};
}

}  // namespace

glm::dvec3 light_point(const Light& light, const std::array<double, 2>& unit) {
  if (const auto* rect = std::get_if<RectLight>(&light.shape)) {
    return {(unit[0] - 0.5) * rect->width, (unit[1] - 0.5) * rect->height, 0};
  }
  if (const auto* emitter = std::get_if<MeshLight>(&light.shape))
    return mesh_surface_point(*emitter->mesh, unit);
  const std::array<double, 2> disk = concentric_disk(unit);
  if (const auto* sun = std::get_if<DistantLight>(&light.shape)) return cap_direction(sun->angle, disk);
  const auto* sphere = std::get_if<SphereLight>(&light.shape);
  const double radius = sphere != nullptr ? sphere->radius : std::get<DiskLight>(light.shape).radius;
  return {disk[0] * radius, disk[1] * radius, 0};
}

glm::dvec3 visible_cap_point(double radius, const glm::dvec3& from, const std::array<double, 2>& unit) {
  const double distance = glm::length(from);
  const glm::dvec3 axis = -from / distance;
  const glm::dvec3 other = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(axis, u);
  const double sine_most = radius / distance;
  // 1 - cos T without the difference of numbers that are nearly equal.
  const double height = sine_most * sine_most / (1 + std::sqrt(1 - sine_most * sine_most));
  const std::array<double, 2> disk = concentric_disk(unit);
  const double squared = disk[0] * disk[0] + disk[1] * disk[1];
  const double cosine = 1 - squared * height, scale = std::sqrt(height * (2 - squared * height));
  const glm::dvec3 direction = disk[0] * scale * u + disk[1] * scale * v + cosine * axis;
  const double across = distance * distance * squared * height * (2 - squared * height);
  return from + (distance * cosine - std::sqrt(std::max(0.0, radius * radius - across))) * direction;
}

glm::dvec3 model_ball_point(const std::array<double, 2>& unit, const std::array<double, 2>& more) {
  // Box and Muller, "A Note on the Generation of Random Normal Deviates", 1958.
  const auto normal_pair = [](const std::array<double, 2>& x) {
    const double length = std::sqrt(-2 * std::log(1 - x[0])), angle = 2 * std::numbers::pi * x[1];
    return std::array{length * std::cos(angle), length * std::sin(angle)};
  };
  const auto a = normal_pair(unit), b = normal_pair(more);
  const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + b[0] * b[0] + b[1] * b[1]);
  return glm::dvec3(a[0], a[1], b[0]) / std::max(length, std::numeric_limits<double>::min());
}

LightSurface::LightSurface(const Light& light) : light_(light) {
  if (!light.emission) return;
  const EmissionImage& image = *light.emission;
  const std::size_t width = image.width, height = image.height;
  share_before_.assign(width + width * height, 0);
  std::vector<double> column_sum(width, 0);
  double total = 0;
  for (std::size_t i = 0; i < width; ++i) {
    for (std::size_t j = 0; j < height; ++j) {
      share_before_[width + i * height + j] = column_sum[i];
      column_sum[i] += static_cast<double>(image.luminance[j * width + i]);
    }
    share_before_[i] = total;
    total += column_sum[i];
  }
  for (std::size_t i = 0; i < width; ++i) {
    share_before_[i] /= total;
    for (std::size_t j = 0; j < height && column_sum[i] > 0; ++j)
      share_before_[width + i * height + j] /= column_sum[i];
  }
}

std::array<double, 2> LightSurface::on_picture(const std::array<double, 2>& unit) const {
  const std::size_t width = light_.emission->width, height = light_.emission->height;
  const auto shares = share_before_.begin();
  const auto columns = shares + static_cast<std::ptrdiff_t>(width);
  const Bin column = find_bin(shares, columns, unit[0]);
  const auto texels = columns + static_cast<std::ptrdiff_t>(column.index * height);
  const Bin texel = find_bin(texels, texels + static_cast<std::ptrdiff_t>(height), unit[1]);
  return {(static_cast<double>(column.index) + column.within) / static_cast<double>(width),
          (static_cast<double>(texel.index) + texel.within) / static_cast<double>(height)};
}

glm::dvec3 LightSurface::point(const std::array<double, 2>& unit) const {
  if (!light_.emission) return light_point(light_, unit);
  const auto* disk = std::get_if<DiskLight>(&light_.shape);
  if (disk == nullptr) return light_point(light_, on_picture(unit));
  const std::uint64_t seed =
      hash_bits(std::bit_cast<std::uint64_t>(unit[0]), std::bit_cast<std::uint64_t>(unit[1]));
  std::array<double, 2> drawn = unit;
  for (std::uint64_t n = 0;; drawn = hash_unit_pair(seed, n++)) {
    const auto [u, v] = on_picture(drawn);
    const glm::dvec3 p(2 * u - 1, 2 * v - 1, 0);
    if (glm::dot(p, p) <= 1) return p * disk->radius;
  }
}

JitteredGrid::JitteredGrid(std::uint32_t count)
    : count_(count),
      rows_(std::max(1U, static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(count)))))),
      shorter_(count / rows_),
      longer_rows_(count % rows_) {}

std::array<double, 2> JitteredGrid::point(std::uint32_t index, std::uint64_t seed) const {
  // The first `longer_rows_` rows have one cell more than the others.
  const std::uint32_t in_longer = longer_rows_ * (shorter_ + 1);
  const bool longer = index < in_longer;
  const std::uint32_t cells = longer ? shorter_ + 1 : shorter_;
  const std::uint32_t within = longer ? index : index - in_longer;
  const std::uint32_t first = index - within % cells;

  const std::array<double, 2> jitter = hash_unit_pair(seed, index);
  return {(within % cells + jitter[0]) / cells, (first + cells * jitter[1]) / count_};
}

}  // namespace pdsm
