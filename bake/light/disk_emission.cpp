// SPDX-License-Identifier: Apache-2.0
#include "light/disk_emission.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pdsm {
namespace {

/// Half of the unit disk's chord at height y.
double half_chord(double y) {
  return std::sqrt(std::max(0.0, 1 - y * y));
}

/// Area between the axis and the disk's rim, from height 0 to y in [0, 1].
double half_disk(double y) {
  return (y * half_chord(y) + std::asin(y)) / 2;
}

/// Integral over heights from 0 to y of min(x, half chord), for x in [0, 1]; odd in y.
double area_below(double x, double y) {
  const double up = std::min(std::abs(y), 1.0), rim = half_chord(x);
  const double area = up <= rim ? x * up : x * rim + half_disk(up) - half_disk(rim);
  return std::copysign(area, y);
}

/// Of the disk between heights y0 and y1, what lies between the axis and x in [-1, 1]; odd in x.
double area_beside(double x, double y0, double y1) {
  const double edge = std::min(std::abs(x), 1.0);
  return std::copysign(area_below(edge, y1) - area_below(edge, y0), x);
}

/// Of `count` equal parts of [-1, 1], where part n begins.
double edge_of(std::size_t n, std::uint32_t count) {
  return 2 * static_cast<double>(n) / count - 1;
}

}  // namespace

double share_on_light(const Light& light, std::uint32_t column, std::uint32_t row) {
  if (!std::holds_alternative<DiskLight>(light.shape)) return 1;
  const std::uint32_t width = light.emission->width, height = light.emission->height;
  const double y0 = edge_of(row, height), y1 = edge_of(std::size_t{row} + 1, height);
  const double area = area_beside(edge_of(std::size_t{column} + 1, width), y0, y1) -
                      area_beside(edge_of(column, width), y0, y1);
  return std::clamp(area * width * height / 4, 0.0, 1.0);
}

DiskEmissionWarp::DiskEmissionWarp(const EmissionImage& image) : image_(image) {
  before_.push_back(0);
  for (std::size_t row = 0; row < image_.height; ++row)
    before_.push_back(before_.back() + emitted(row, edge_y(row), edge_y(row + 1)));
}

double DiskEmissionWarp::edge_x(std::size_t column) const {
  return edge_of(column, image_.width);
}

double DiskEmissionWarp::edge_y(std::size_t row) const {
  return edge_of(row, image_.height);
}

double DiskEmissionWarp::emitted(std::size_t row, double y0, double y1) const {
  double sum = 0, beside = area_beside(-1, y0, y1);
  for (std::size_t column = 0; column < image_.width; ++column) {
    const double next = area_beside(edge_x(column + 1), y0, y1);
    const auto luminance = static_cast<double>(image_.luminance[row * image_.width + column]);
    sum += luminance * std::max(0.0, next - beside);
    beside = next;
  }
  return sum;
}

double DiskEmissionWarp::innermost_x(std::size_t row) const {
  double innermost = 1;
  for (std::size_t column = 0; column < image_.width; ++column) {
    if (!(image_.luminance[row * image_.width + column] > 0)) continue;
    const double x = std::clamp(0.0, edge_x(column), edge_x(column + 1));
    if (std::abs(x) < std::abs(innermost)) innermost = x;
  }
  return innermost;
}

/// The height up to which a row emits `wanted`, by bisection: what is emitted grows with it.
double DiskEmissionWarp::height_at(std::size_t row, double wanted) const {
  // Beyond `top` the chord is too short for what emits.
  const double begin = edge_y(row), top = half_chord(innermost_x(row));
  double low = std::max(begin, -top), high = std::min(edge_y(row + 1), top);
  for (int step = 0; step < std::numeric_limits<double>::digits; ++step) {
    const double middle = (low + high) / 2;
    (emitted(row, begin, middle) <= wanted ? low : high) = middle;
  }
  // Something is emitted between the two, and at the one with the longer chord.
  return std::abs(low) < std::abs(high) ? low : high;
}

double DiskEmissionWarp::along_chord(std::size_t row, double y, double unit) const {
  const double half = half_chord(y);
  const auto begin_of = [&](std::size_t column) { return std::clamp(edge_x(column), -half, half); };
  const auto emitted_by = [&](std::size_t column) {
    return static_cast<double>(image_.luminance[row * image_.width + column]) *
           (begin_of(column + 1) - begin_of(column));
  };
  double all = 0;
  for (std::size_t column = 0; column < image_.width; ++column) all += emitted_by(column);
  double rest = unit * all, x = innermost_x(row);
  for (std::size_t column = 0; column < image_.width; ++column) {
    const double own = emitted_by(column);
    if (!(own > 0)) continue;
    const double begin = begin_of(column), length = begin_of(column + 1) - begin;
    x = begin + length * std::min(1.0, rest / own);
    if (rest < own) break;
    rest -= own;
  }
  return x;
}

std::array<double, 2> DiskEmissionWarp::operator()(const std::array<double, 2>& unit) const {
  const double wanted = unit[1] * before_.back();
  auto next = std::upper_bound(before_.begin(), before_.end(), wanted);
  if (next == before_.end()) next = std::lower_bound(before_.begin(), before_.end(), before_.back());
  const auto row = static_cast<std::size_t>(next - before_.begin() - 1);
  const double y = height_at(row, wanted - before_[row]);
  return {along_chord(row, y, unit[0]), y};
}

}  // namespace pdsm
