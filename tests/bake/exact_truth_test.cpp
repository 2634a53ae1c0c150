// SPDX-License-Identifier: Apache-2.0
// Bakes of scenes whose attenuation is known in closed form, at the texels' own rays.
//
// The tolerance is the chain's promise (numerics.md section 4), each term bounded by itself:
//   sampling      sampling_tolerance(): sqrt(K ln(2 / 1e-6) / 2) / N for K strata crossed
//   maps          a map texel stands for points up to `reach` texels away, so an edge at depth h appears
//                 displaced by at most d = reach pitch h: V lies between V of the edge moved by +d and -d
//   fit           epsilon, and the extremes of V over depths within delta, quantisation included
// Where a shadow begins, the bias delays it: between h and h + bias + 2 delta only the upper bound holds.
#include <gtest/gtest.h>

#include "support/baked_functions.h"
#include "support/exact_truth.h"
#include "support/truth_bounds.h"

namespace pdsm::test {
namespace {

std::string method_name(const testing::TestParamInfo<Method>& method) {
  const std::string walk = method.param.walk == Walk::exact ? "Exact" : "Midpoint";
  const std::string points = method.param.points == PointSet::lattice ? "Lattice" : "Jittered";
  return walk + points + (method.param.epsilon == 0 ? "Lossless" : "Fitted");
}

class ExactTruth : public testing::TestWithParam<Method> {
 protected:
  static constexpr double kFar = 8;
  static constexpr double kOccluder = 3;
  static constexpr std::uint32_t kSamples = 256;

  [[nodiscard]] static BakeOptions options(std::uint32_t width, std::uint32_t height,
                                           std::uint32_t map_scale) {
    return method_options(GetParam(), width, height, kSamples, map_scale);
  }

  /// Compares all depths of one texel with the truth; `displacement`: how far edges may appear moved.
  static void expect_truth(const BakedFunctions& baked, std::uint32_t i, std::uint32_t j,
                           const ShiftedTruth& truth, double displacement, double sampling, double occluder) {
    const double delta = baked.report().depth_tolerance, epsilon = baked.report().epsilon;
    const double begin = occluder + baked.report().bias + 2 * delta;
    for (int n = 0; n <= 60; ++n) {
      const double z = baked.view().near_depth + (kFar - baked.view().near_depth) * n / 60 * 0.999;
      const double value = baked.value(i, j, z);
      if (z <= occluder) {
        ASSERT_EQ(value, 0) << "z " << z;
        continue;
      }
      // Past the begin the window of delta lies wholly behind the occluder; before, V is at most what a
      // receiver right behind the occluder sees.
      const Bounds b = z > begin ? bound(truth, z, delta, displacement) : Bounds{0, 1};
      ASSERT_GE(value, b.low - sampling - epsilon) << "texel " << i << ", " << j << ", z " << z;
      ASSERT_LE(value, b.high + sampling + epsilon) << "texel " << i << ", " << j << ", z " << z;
    }
  }
};

/// Light 2 x 1, half plane x > a.
TEST_P(ExactTruth, RectangleLightAndHalfPlane) {
  Light light = rect_light(2, 1);
  set_view(light, 0.5, 0.25, 2, kFar);
  const double edge = 0.3;
  Scene scene;
  add(scene, Plate{edge, -kWide, kWide, kWide, kOccluder});
  add(scene, Plate{-kWide, -kWide, kWide, kWide, kFar});
  const BakedFunctions baked(scene, light, options(33, 5, 4));
  const double displacement = texel_reach(GetParam().walk) * baked.map_pitch_x() * kOccluder;
  for (std::uint32_t j = 0; j < 5; ++j) {
    for (std::uint32_t i = 0; i < 33; ++i) {
      const double d = baked.slope_x(i);
      const ShiftedTruth truth = [&](double z, double shift) {
        return rect_half_plane(2, back_project(edge - shift, kOccluder, d, z));
      };
      expect_truth(baked, i, j, truth, displacement, sampling_tolerance(edge_strata(kSamples), kSamples),
                   kOccluder);
    }
  }
}

/// An edge that the ray itself meets hides half the light at every depth behind it.
TEST_P(ExactTruth, EdgeOnTheRayHidesHalf) {
  Light light = rect_light(2, 1);
  set_view(light, 0.5, 0.25, 2, kFar);
  const double slope = -0.5 + (20 + 0.5) / 33;
  Scene scene;
  add(scene, Plate{slope * kOccluder, -kWide, kWide, kWide, kOccluder});
  add(scene, Plate{-kWide, -kWide, kWide, kWide, kFar});
  const BakedFunctions baked(scene, light, options(33, 5, 8));
  const double displacement = texel_reach(GetParam().walk) * baked.map_pitch_x() * kOccluder;
  const ShiftedTruth truth = [&](double z, double shift) {
    return rect_half_plane(2, back_project(slope * kOccluder - shift, kOccluder, slope, z));
  };
  ASSERT_NEAR(truth(5, 0), 0.5, 1e-12);
  expect_truth(baked, 20, 2, truth, displacement, sampling_tolerance(edge_strata(kSamples), kSamples),
               kOccluder);
}

/// Square light of side 1.6, half plane whose edge normal has angle theta.
TEST_P(ExactTruth, SquareLightAndSlantedEdge) {
  Light light = rect_light(1.6, 1.6);
  set_view(light, 0.4, 0.4, 2, kFar);
  for (const double degrees : {10.0, 45.0, 110.0, 233.0}) {
    const double theta = degrees * std::numbers::pi / 180, offset = 0.2;
    const glm::dvec3 normal(std::cos(theta), std::sin(theta), 0), along(-normal.y, normal.x, 0),
        up(0, 0, kOccluder);
    Scene scene;
    add(scene, quad_mesh(up + offset * normal - kWide * along, up + kWide * normal - kWide * along,
                         up + kWide * normal + kWide * along, up + offset * normal + kWide * along));
    add(scene, Plate{-kWide, -kWide, kWide, kWide, kFar});
    const BakedFunctions baked(scene, light, options(9, 9, 8));
    const double footprint = texel_reach(GetParam().walk) * baked.map_pitch_x() * kOccluder;
    // The corner of a texel is the farthest along the normal. The quad's corners lie on a grid of floats
    // at 1000, which moves the edge by up to 2^-15.
    const double displacement = footprint * (std::abs(normal.x) + std::abs(normal.y)) + 0x1.0p-14;
    for (std::uint32_t j = 0; j < 9; ++j) {
      for (std::uint32_t i = 0; i < 9; ++i) {
        const double d = baked.slope_x(i) * normal.x + baked.slope_y(j) * normal.y;
        const ShiftedTruth truth = [&](double z, double shift) {
          return square_half_plane(1.6, theta, back_project(offset - shift, kOccluder, d, z));
        };
        expect_truth(baked, i, j, truth, displacement, sampling_tolerance(edge_strata(kSamples), kSamples),
                     kOccluder);
      }
    }
  }
}

/// The concentric map turns a line into a curve that is monotone on each half of the square: twice the
/// strata of a line at most.
TEST_P(ExactTruth, DiskLightAndHalfPlane) {
  Light light = disk_light(0.9);
  set_view(light, 0.5, 0.2, 2, kFar);
  const double edge = -0.1;
  Scene scene;
  add(scene, Plate{edge, -kWide, kWide, kWide, kOccluder});
  add(scene, Plate{-kWide, -kWide, kWide, kWide, kFar});
  const BakedFunctions baked(scene, light, options(33, 5, 4));
  const double displacement = texel_reach(GetParam().walk) * baked.map_pitch_x() * kOccluder;
  for (std::uint32_t i = 0; i < 33; ++i) {
    const double d = baked.slope_x(i);
    const ShiftedTruth truth = [&](double z, double shift) {
      return disk_half_plane(0.9, back_project(edge - shift, kOccluder, d, z));
    };
    expect_truth(baked, i, 2, truth, displacement, sampling_tolerance(2 * edge_strata(kSamples), kSamples),
                 kOccluder);
  }
}

/// A sphere on the axis, seen on the axis: between the truths of spheres that are smaller and larger by the
/// map texel's diagonal at the sphere's far side, and by what the mesh cuts off. Near the silhouette the
/// slope bias grows without bound; it delays the shadow of the ring where
///   slope bias = bias_reach t tan(alpha) > z - h - r - bias
/// which is narrower than r (1 - sin alpha); t < h + r.
TEST_P(ExactTruth, SphereOnTheAxis) {
  const double r = 0.5, h = 3;
  const Mesh sphere = sphere_mesh({0, 0, h}, r, 5);
  const double cut_off = r - inscribed_radius(sphere, {0, 0, h});
  Scene scene;
  add(scene, sphere);
  add(scene, Plate{-kWide, -kWide, kWide, kWide, kFar});
  for (const bool is_disk : {true, false}) {
    Light light = is_disk ? disk_light(0.9) : rect_light(1.8, 1.8);
    set_view(light, 0.15, 0.15, 2, kFar);
    const BakedFunctions baked(scene, light, options(3, 3, 24));
    const double reach = texel_reach(GetParam().walk) * baked.map_pitch_x() * std::sqrt(2.0);
    // The slope bias allows for a PDSM texel in place of half a map texel.
    const double bias_reach = reach + (24 - 0.5) * baked.map_pitch_x() * std::sqrt(2.0);
    const double delta = baked.report().depth_tolerance, epsilon = baked.report().epsilon;
    const double sampling = sampling_tolerance(outline_strata(kSamples), kSamples);
    const auto truth = [&](double radius, double z) {
      const double rho = sphere_shadow_radius(radius, h, z);
      if (is_disk) return std::min(1.0, rho * rho / 0.81);
      return rho <= 0.9 ? std::numbers::pi * rho * rho / 3.24 : -1;
    };
    for (double z = 4.5; z < 7.99; z += 0.25) {
      const double alpha = std::atan((z - delta - h - r - baked.report().bias) / (bias_reach * (h + r)));
      const double moved = reach * (h + r), ring = r * (1 - std::sin(alpha));
      const double low = truth(r - cut_off - moved - ring, z + delta), high = truth(r + moved, z - delta);
      if (low < 0 || high < 0) continue;
      const double value = baked.value(1, 1, z);
      EXPECT_GE(value, low - sampling - epsilon) << "z " << z;
      EXPECT_LE(value, high + sampling + epsilon) << "z " << z;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, ExactTruth,
                         testing::Values(Method{Walk::exact, PointSet::lattice, 0.02},
                                         Method{Walk::exact, PointSet::jittered, 0},
                                         Method{Walk::midpoint, PointSet::lattice, 0},
                                         Method{Walk::midpoint, PointSet::jittered, 0.02},
                                         Method{Walk::exact, PointSet::lattice, 0},
                                         Method{Walk::exact, PointSet::jittered, 0.01}),
                         method_name);

}  // namespace
}  // namespace pdsm::test
