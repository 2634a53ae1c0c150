// SPDX-License-Identifier: Apache-2.0
// Additive recurrences: Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018.
#include "light/mesh_samples.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "light/hilbert_curve.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Candidates in all, where samples are few, and for each sample, where they are many.
constexpr std::uint32_t kCandidates = 16384, kLeastCandidates = 16;
/// The inverse of the root of x^6 = x + 1, the golden ratio of five dimensions.
constexpr double kInverseRatio = 1 / 1.13472413840151949260;
/// Of a candidate's numbers: the first dimension of seeds and hashes (others are light_samples.cpp's).
constexpr std::uint64_t kFirstDimension = 10;
/// Share of the mesh's size that rays start off the surface.
constexpr float kOwnSurface = 1e-5F;

struct Triangle {
  std::array<glm::dvec3, 3> corners;

  /// Twice its area long.
  [[nodiscard]] glm::dvec3 normal() const {
    return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  }
};

Triangle triangle_of(const Mesh& mesh, std::size_t n) {
  const glm::uvec3& t = mesh.triangles[n];
  return {glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])};
}

void throw_embree_error(void*, RTCError code, const char* message) {
  throw Error(Failure::resource, "embree", std::string(message) + " (" + std::to_string(code) + ")");
}

/// The mesh in Embree. Its ISA is one that all machines have: samples must not depend on the machine.
class Chords {
 public:
  explicit Chords(const Mesh& mesh) : device_(rtcNewDevice("isa=sse2,threads=1")) {
    for (const glm::vec3& p : mesh.positions)
      own_surface_ = std::max(own_surface_, kOwnSurface * glm::length(p));
    if (!device_) throw_embree_error(nullptr, rtcGetDeviceError(nullptr), "cannot make a device");
    rtcSetDeviceErrorFunction(device_.get(), throw_embree_error, nullptr);
    scene_.reset(rtcNewScene(device_.get()));
    const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(),
                               0, sizeof(glm::vec3), mesh.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                               sizeof(glm::uvec3), mesh.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_.get());
  }

  /// Length of the chord from a point of the surface, into the mesh; 0 where the ray finds no way out.
  [[nodiscard]] double length(const glm::dvec3& from, const glm::dvec3& direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const glm::vec3 o(from), d(direction);
    RTCRayHit ray{};
    ray.ray = {o.x, o.y, o.z, own_surface_, d.x, d.y, d.z, 0, std::numeric_limits<float>::infinity(),
               ~0U, 0,   0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_.get(), &context, &ray);
    return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? 0 : static_cast<double>(ray.ray.tfar);
  }

 private:
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> scene_;
  float own_surface_ = 0;  ///< metres from its start in which a ray may meet the triangle that it is on
};

/// Makes candidates: on a closed mesh the point of a chord, by the arcsine distribution, on others one of the
/// surface.
class CandidateMaker {
 public:
  CandidateMaker(const Mesh& mesh, std::uint32_t count, const SampleSet& set)
      : mesh_(mesh), count_(count), set_(set) {
    double volume = 0;
    area_before_.push_back(0);
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
      const Triangle triangle = triangle_of(mesh, n);
      area_before_.push_back(area_before_.back() + glm::length(triangle.normal()));
      volume += glm::dot(triangle.normal(), triangle.corners[0]);
    }
    if (!mesh.closed) return;
    chords_.emplace(mesh);
    inwards_ = volume > 0 ? -1 : 1;
  }

  [[nodiscard]] glm::dvec3 make(std::uint32_t i) const {
    const double wanted = number(i, 0) * area_before_.back();
    const auto after = std::upper_bound(area_before_.begin(), area_before_.end() - 1, wanted);
    const auto n = static_cast<std::size_t>(after - area_before_.begin() - 1);
    const Triangle triangle = triangle_of(mesh_, n);
    const auto& c = triangle.corners;
    const double root = std::sqrt(number(i, 1)), along = number(i, 2);
    const glm::dvec3 p = (1 - root) * c[0] + root * ((1 - along) * c[1] + along * c[2]);
    if (!chords_) return p;
    const glm::dvec3 direction = cosine_direction(inwards_ * glm::normalize(triangle.normal()), i);
    const double share = (1 - std::cos(std::numbers::pi * number(i, 5))) / 2;
    return p + share * chords_->length(p, direction) * direction;
  }

 private:
  /// In [0, 1); of dimension 0 in order, one for each equal part.
  [[nodiscard]] double number(std::uint32_t i, std::uint32_t dimension) const {
    const bool jittered = set_.points == PointSet::jittered;
    const std::uint64_t stream = kFirstDimension + dimension;
    if (dimension == 0) return (i + (jittered ? hash_uniform(set_.seed, i, stream) : 0.5)) / count_;
    if (jittered) return hash_uniform(set_.seed, i, stream);
    return fraction(0.5 + i * std::pow(kInverseRatio, dimension) + seed_shift(set_.seed, stream));
  }

  /// About a unit vector, with density cos / pi: so the chords through a surface are those of random lines.
  [[nodiscard]] glm::dvec3 cosine_direction(const glm::dvec3& axis, std::uint32_t i) const {
    const double squared = number(i, 3), angle = 2 * std::numbers::pi * number(i, 4);
    const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(axis, other)), v = glm::cross(axis, u);
    const double sine = std::sqrt(squared);
    return sine * (std::cos(angle) * u + std::sin(angle) * v) + std::sqrt(1 - squared) * axis;
  }

  const Mesh& mesh_;
  std::uint32_t count_;
  const SampleSet& set_;
  std::vector<double> area_before_;
  std::optional<Chords> chords_;
  double inwards_ = 1;  ///< times the normal of the winding
};

}  // namespace

std::vector<std::array<double, 3>> mesh_samples(const Mesh& mesh, const SampleSet& set) {
  const std::uint32_t each = std::max(kLeastCandidates, kCandidates / set.count), all = each * set.count;
  const CandidateMaker maker(mesh, all, set);
  std::vector<glm::dvec3> candidates(all);
  for (std::uint32_t i = 0; i < all; ++i) candidates[i] = maker.make(i);
  sort_along_hilbert_curve(candidates);
  std::vector<std::array<double, 3>> samples;
  for (std::uint32_t i = 0; i < set.count; ++i) {
    const double within =
        set.points == PointSet::jittered ? hash_uniform(set.seed, i, kFirstDimension - 1) : 0.5;
    const auto& p = candidates[i * each + static_cast<std::uint32_t>(within * each)];
    samples.push_back({p.x, p.y, p.z});
  }
  return samples;
}

}  // namespace pdsm
