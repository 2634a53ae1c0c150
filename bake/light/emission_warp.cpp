// SPDX-License-Identifier: Apache-2.0
#include "light/emission_warp.h"

#include <algorithm>
#include <span>

namespace pdsm {
namespace {

/// A place in a row of shares, and how far into it.
struct Place {
  std::size_t index = 0;
  double within = 0;

  [[nodiscard]] double of(std::uint32_t count) const { return (static_cast<double>(index) + within) / count; }
};

/// What lies `unit` of the way through shares, given by the sums before them; never one without a share.
Place place_at(std::span<const double> sums, double unit) {
  const double wanted = unit * sums.back();
  auto next = std::upper_bound(sums.begin(), sums.end(), wanted);
  if (next == sums.end()) next = std::lower_bound(sums.begin(), sums.end(), sums.back());
  const double before = *std::prev(next);
  return {static_cast<std::size_t>(next - sums.begin() - 1),
          std::clamp((wanted - before) / (*next - before), 0.0, 1.0)};
}

}  // namespace

EmissionWarp::EmissionWarp(const EmissionImage& image) : width_(image.width), height_(image.height) {
  rows_.reserve(std::size_t{height_} + 1);
  columns_.reserve((std::size_t{width_} + 1) * height_);
  rows_.push_back(0);
  for (std::uint32_t j = 0; j < height_; ++j) {
    double sum = 0;
    columns_.push_back(0);
    for (std::uint32_t i = 0; i < width_; ++i)
      columns_.push_back(sum += static_cast<double>(image.luminance[std::size_t{j} * width_ + i]));
    rows_.push_back(rows_.back() + sum);
  }
}

std::array<double, 2> EmissionWarp::operator()(const std::array<double, 2>& unit) const {
  const Place row = place_at(rows_, unit[1]);
  const std::size_t across = std::size_t{width_} + 1;
  const Place column = place_at(std::span(columns_).subspan(across * row.index, across), unit[0]);
  return {column.of(width_), row.of(height_)};
}

}  // namespace pdsm
