// SPDX-License-Identifier: Apache-2.0
#include "truth/channel_rays.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "truth/random.h"

namespace pdsm {
namespace {

constexpr std::uint32_t kPacketSize = 16;  // the widest that Embree has
/// Where a ray begins, as a share of its way to the light point: off the surface it starts on.
constexpr double kRayStart = 1e-4;
/// Depth of the emitter as a share of near (design.md section 7).
constexpr double kEmitterShare = 1e-4;

bool is_caster(const Geometry& geometry) {
  return casts_shadows(geometry);
}

glm::dvec3 rotate(const RigidTransform& transform, const glm::dvec3& v) {
  const auto& r = transform.rotation;
  return {r[0] * v.x + r[1] * v.y + r[2] * v.z, r[3] * v.x + r[4] * v.y + r[5] * v.z,
          r[6] * v.x + r[7] * v.y + r[8] * v.z};
}

}  // namespace

/// Rays from one point to up to 16 light points, `t` from 0 at the point to 1 at the light, or where a
/// distant light's space begins.
struct ChannelRays::Packet {
  glm::dvec3 world_point;
  glm::vec3 origin;                      ///< the point, from the casters' centre
  double depth;                          ///< of the point, light space
  std::array<double, kPacketSize> rise;  ///< metres of depth for a change of t by 1
  std::uint32_t size = 0;
  std::array<glm::vec3, kPacketSize> direction;
  std::array<float, kPacketSize> end;
  std::array<LightPoint, kPacketSize> light_point;
  std::array<double, kPacketSize> weight;
};

/// A light point and the share of the light that it stands for, up to a factor.
struct ChannelRays::WeightedPoint {
  LightPoint point;
  double weight = 1;
};

/// What the filter of biased rays, and of rays through translucent surfaces, knows; rays carry their lane as
/// id.
struct ChannelRays::RayContext {
  RTCIntersectContext context;  // first, so that Embree's pointer to it is one to the whole
  const Packet* packet;
  const CasterBias* bias;
  const RigidTransform* world_to_light;
  const TranslucentSurfaces* translucent;
  unsigned curve_ids;                                                 ///< the first
  std::array<TranslucentSurfaces::Crossings, kPacketSize> crossings;  ///< by lane

  [[nodiscard]] glm::dvec3 to_light(const glm::dvec3& v) const { return rotate(*world_to_light, v); }

  /// Whether a caster met at `t` by the ray of `lane` is so near that its shadow begins behind the point.
  [[nodiscard]] bool ignores(unsigned lane, double t, bool is_curve, const glm::dvec3& normal) const {
    const LightPoint& from = packet->light_point[lane];
    const double depth = packet->rise[lane];
    const glm::dvec3 to_caster = -glm::dvec3(packet->direction[lane]) / depth;  // a metre of depth
    if (is_curve) return t * depth <= bias->constant;
    double slope = slope_bias(*bias, from, to_light(normal), to_light(to_caster), (1 - t) * depth);
    if (bias->behind != nullptr && slope > bias->limited_from) {
      const double near = std::max(bias->same_surface * bias->constant, bias->least_gap * (1 - t) * depth);
      const glm::dvec3 at = packet->world_point - t * depth * to_caster;
      const auto next = bias->behind->meet(LitSurfaces::Heading::from_light, at, to_caster, near,
                                           slope / bias->way_to_next);
      if (next) slope = std::min(slope, bias->way_to_next * next->distance);
    }
    return t * depth <= bias->constant + slope;
  }

  static void filter(const RTCFilterFunctionNArguments* args) {
    auto& self = *reinterpret_cast<RayContext*>(args->context);
    const unsigned n = args->N;
    for (unsigned i = 0; i < n; ++i) {
      if (args->valid[i] != -1) continue;
      const glm::dvec3 normal(RTCHitN_Ng_x(args->hit, n, i), RTCHitN_Ng_y(args->hit, n, i),
                              RTCHitN_Ng_z(args->hit, n, i));
      const auto t = static_cast<double>(RTCRayN_tfar(args->ray, n, i));
      const unsigned lane = RTCRayN_id(args->ray, n, i);
      const bool is_curve = RTCHitN_geomID(args->hit, n, i) >= self.curve_ids;
      if ((self.bias != nullptr && self.ignores(lane, t, is_curve, normal)) ||
          self.translucent->cross(*args, i, self.crossings[lane]))
        args->valid[i] = 0;
    }
  }
};

namespace {

std::optional<double> radius_of(const Light& light) {
  const auto* sphere = std::get_if<SphereLight>(&light.shape);
  return sphere == nullptr ? std::nullopt : std::optional(sphere->radius);
}

std::unique_ptr<const MeshEmitter> emitter_of(const Light& light) {
  const auto* shape = std::get_if<MeshLight>(&light.shape);
  return shape == nullptr ? nullptr : std::make_unique<const MeshEmitter>(*shape->mesh);
}

}  // namespace

ChannelRays::ChannelRays(const Scene& scene, const Light& light, double near_depth)
    : light_(light),
      world_to_light_(light_frame(light)),
      light_to_world_(inverse(world_to_light_)),
      distant_(is_distant(light)),
      sphere_radius_(radius_of(light)),
      emitter_(emitter_of(light)),
      emitter_depth_(distant_ || is_body(light) ? -std::numeric_limits<double>::infinity()
                                                : kEmitterShare * near_depth),
      // Triangles within the emitter are left out rather than cut off by the rays' end, where floats are
      // too coarse to tell a lamp's own face from what lies just before it.
      casters_(
          scene, is_caster, Holes::open,
          [this](const std::array<glm::dvec3, 3>& corners) {
            return std::any_of(corners.begin(), corners.end(), [this](const glm::dvec3& corner) {
              return apply(world_to_light_, corner).z > emitter_depth_;
            });
          },
          [](const Curves& curves) { return casts_shadows(curves); }),
      curve_ids_(static_cast<unsigned>(scene.geometry.size())),
      translucent_(scene, casters_),
      volumes_(scene) {}

double ChannelRays::attenuation(const glm::dvec3& world_point, std::uint32_t samples,
                                std::uint64_t seed) const {
  const JitteredGrid grid(samples);
  const glm::dvec3 from = apply(world_to_light_, world_point);
  if (sphere_radius_) {
    const auto seen = [&](std::uint32_t n) {
      return WeightedPoint{{visible_cap_point(*sphere_radius_, from, grid.point(n, seed))}};
    };
    return share_blocked(world_point, samples, seen, nullptr);
  }
  if (emitter_) {
    const auto seen = [&](std::uint32_t n) {
      const MeshEmitter::Seen part = emitter_->seen(from, grid.point(n, seed));
      return WeightedPoint{{part.point}, part.weight};
    };
    return share_blocked(world_point, samples, seen, nullptr);
  }
  const auto drawn = [&](std::uint32_t n) { return WeightedPoint{{light_.point(grid.point(n, seed))}}; };
  return share_blocked(world_point, samples, drawn, nullptr);
}

double ChannelRays::model_attenuation(const glm::dvec3& world_point, std::uint32_t samples,
                                      std::uint64_t seed) const {
  assert(sphere_radius_ || emitter_);
  const JitteredGrid grid(samples);
  const auto drawn = [&](std::uint32_t n) {
    const std::array<double, 2> unit = grid.point(n, seed), more = hash_unit_pair(~seed, n);
    if (emitter_)
      return WeightedPoint{{emitter_->model_point(unit, more, hash_unit(hash_bits(~seed, n), 1))}};
    return WeightedPoint{{*sphere_radius_ * model_ball_point(unit, more)}};
  };
  return share_blocked(world_point, samples, drawn, nullptr);
}

double ChannelRays::attenuation(const glm::dvec3& world_point, std::span<const LightPoint> light_points,
                                const CasterBias* bias) const {
  const auto given = [&](std::uint32_t n) { return WeightedPoint{light_points[n]}; };
  return share_blocked(world_point, static_cast<std::uint32_t>(light_points.size()), given, bias);
}

template <typename MakePoint>
double ChannelRays::share_blocked(const glm::dvec3& world_point, std::uint32_t count,
                                  const MakePoint& light_point, const CasterBias* bias) const {
  assert(count >= 1);
  Packet packet;
  const glm::dvec3 in_light_space = apply(world_to_light_, world_point);
  packet.depth = in_light_space.z;
  if (!is_lit_side(in_light_space)) return 0;
  packet.world_point = world_point;
  packet.origin = glm::vec3(world_point - casters_.centre());
  double blocked = 0, all = 0;
  for (std::uint32_t first = 0; first < count; first += kPacketSize) {
    const std::uint32_t size = std::min(kPacketSize, count - first);
    packet.size = 0;
    for (std::uint32_t i = 0; i < size; ++i) {
      const WeightedPoint drawn = light_point(first + i);
      if (!(drawn.weight > 0)) continue;
      all += drawn.weight;
      add_ray(drawn, packet);
    }
    blocked += sum_blocked(packet, bias);
    if (count - first <= kPacketSize) break;  // first + 16 may not fit 32 bits
  }
  return all > 0 ? blocked / all : 0;
}

bool ChannelRays::is_lit_side(const glm::dvec3& p) const {
  if (emitter_) return true;
  return sphere_radius_ ? glm::length(p) > *sphere_radius_ : p.z > std::max(emitter_depth_, 0.0);
}

void ChannelRays::add_ray(const WeightedPoint& drawn, Packet& packet) const {
  const std::uint32_t n = packet.size++;
  const LightPoint& point = drawn.point;
  packet.light_point[n] = point;
  packet.weight[n] = drawn.weight;
  if (distant_) {
    packet.rise[n] = packet.depth;
    packet.direction[n] = glm::vec3(-packet.depth * rotate(light_to_world_, point.position));
    packet.end[n] = std::numeric_limits<float>::infinity();
  } else {
    packet.rise[n] = packet.depth - point.position.z;
    packet.direction[n] = glm::vec3(apply(light_to_world_, point.position) - packet.world_point);
    packet.end[n] = sphere_radius_ || emitter_
                        ? 1.0F
                        : static_cast<float>(std::min(1.0, (packet.depth - emitter_depth_) / packet.rise[n]));
  }
}

double ChannelRays::sum_blocked(const Packet& packet, const CasterBias* bias) const {
  alignas(64) std::array<int, kPacketSize> valid{};
  RTCRay16 rays{};
  for (std::uint32_t i = 0; i < packet.size; ++i) {
    valid[i] = -1;
    rays.org_x[i] = packet.origin.x;
    rays.org_y[i] = packet.origin.y;
    rays.org_z[i] = packet.origin.z;
    rays.dir_x[i] = packet.direction[i].x;
    rays.dir_y[i] = packet.direction[i].y;
    rays.dir_z[i] = packet.direction[i].z;
    rays.tnear[i] = static_cast<float>(kRayStart);
    rays.tfar[i] = packet.end[i];
    rays.mask[i] = ~0U;
    rays.id[i] = i;
  }
  RayContext context{{}, &packet, bias, &world_to_light_, &translucent_, curve_ids_, {}};
  rtcInitIntersectContext(&context.context);
  context.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  if (bias != nullptr || !translucent_.empty()) context.context.filter = RayContext::filter;
  rtcOccluded16(valid.data(), casters_.handle(), &context.context, &rays);

  // Embree marks a blocked ray by a tfar of -inf.
  double blocked = 0;
  for (std::uint32_t i = 0; i < packet.size; ++i)
    blocked += packet.weight[i] *
               (rays.tfar[i] < 0 ? 1
                : volumes_.empty()
                    ? translucent_.share_kept(context.crossings[i])
                    : 1 - (1 - translucent_.share_kept(context.crossings[i])) * left_by_volumes(packet, i));
  return blocked;
}

double ChannelRays::left_by_volumes(const Packet& packet, std::uint32_t lane) const {
  // A distant light's ray ends nowhere, but its volumes do.
  return volumes_.share_left(packet.world_point, glm::dvec3(packet.direction[lane]), kRayStart,
                             static_cast<double>(packet.end[lane]));
}

}  // namespace pdsm
