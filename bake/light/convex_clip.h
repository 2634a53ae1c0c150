// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace pdsm {

/// The points p with dot(normal, p) + offset >= 0.
struct HalfSpace {
  glm::dvec3 normal{0};
  double offset = 0;

  [[nodiscard]] double distance(const glm::dvec3& p) const { return glm::dot(normal, p) + offset; }
};

/// The intersection of up to seven half-spaces.
class ConvexRegion {
 public:
  static constexpr std::size_t kMaxHalfSpaces = 7;

  /// Adds a half-space; at most kMaxHalfSpaces in all.
  void add(const HalfSpace& half_space);

  [[nodiscard]] std::span<const HalfSpace> half_spaces() const { return {half_spaces_.data(), count_}; }

  /// Bit i is set when `p` lies outside half-space i; 0: inside.
  [[nodiscard]] std::uint32_t outside_bits(const glm::dvec3& p) const {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      bits |= static_cast<std::uint32_t>(half_spaces_[i].distance(p) < 0) << i;
    }
    return bits;
  }

 private:
  std::array<HalfSpace, kMaxHalfSpaces> half_spaces_;
  std::size_t count_ = 0;
};

/// A convex polygon of a few corners, on the stack.
class SmallPolygon {
 public:
  SmallPolygon() = default;
  SmallPolygon(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
      : corners_{a, b, c}, count_(3) {}

  void push(const glm::dvec3& corner);
  [[nodiscard]] std::span<const glm::dvec3> corners() const { return {corners_.data(), count_}; }

 private:
  // A triangle gains at most one corner from each half-space.
  std::array<glm::dvec3, 3 + ConvexRegion::kMaxHalfSpaces> corners_;
  std::size_t count_ = 0;
};

/// The part of `polygon` inside `region`, possibly without corners. Only the half-spaces whose bit is set
/// in `crossed` are cut with. Paper: Sutherland, Hodgman, "Reentrant Polygon Clipping", 1974.
[[nodiscard]] SmallPolygon clip(const SmallPolygon& polygon, const ConvexRegion& region,
                                std::uint32_t crossed);

/// Area of a plane polygon.
[[nodiscard]] double area(std::span<const glm::dvec3> polygon);

}  // namespace pdsm
