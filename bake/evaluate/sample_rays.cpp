// SPDX-License-Identifier: Apache-2.0
#include "evaluate/sample_rays.h"

#include <algorithm>

#include "tile/sample_bias.h"
#include "trace/surface_bias.h"
#include "truth/shadow_rays.h"

namespace pdsm {
namespace {

/// A bake's samples with the reach of their bias: a map texel's pitch is a change of slope on the focus
/// plane; seen from a sample at s_z, directions change by F / (F - s_z) of that. A distant light's rays move
/// by the pitch.
std::vector<LightPoint> points_of(const BakeJob& job) {
  const MapGrid& grid = job.grid;
  std::vector<LightPoint> points;
  for (const LightSample& sample : job.samples) {
    const MapBias bias = sample_bias(grid, job.options.walk, job.shift_law(), job.depth_bias(), sample);
    const auto& s = sample.position;
    LightPoint& point = points.emplace_back();
    point.position = {s[0], s[1], s[2]};
    const double lambda = grid.perspective() ? (grid.focus_depth - s[2]) / grid.focus_depth : 1;
    for (std::size_t axis = 0; axis < 2; ++axis)
      point.reach[axis] = bias.reach[axis] * grid.pitch[axis] / lambda;
  }
  return points;
}

}  // namespace

SampleRayValues trace_sample_rays(const Scene& scene, const Light& light, const BakeJob& job,
                                  std::span<const glm::dvec3> points, std::span<const TexelQuad> quads,
                                  std::span<const QuadFunctions> functions) {
  const View& view = job.fitted.view;
  const ShadowRays rays(scene, light, view.near_depth);
  const std::vector<LightPoint> samples = points_of(job);
  const LitSurfaces behind(scene);
  const CasterBias bias{job.bias,
                        view.far_depth,
                        job.slope_limit.from,
                        &behind,
                        SurfaceBias::kWayToNext,
                        SurfaceBias::kSameSurface,
                        SurfaceBias::kLeastGap,
                        !job.grid.perspective()};
  SampleRayValues values;
  for (std::vector<double>* of : {&values.at_point, &values.biased, &values.filtered})
    of->resize(points.size());

#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t n = 0; n < points.size(); ++n) {
    values.at_point[n] = rays.attenuation(points[n], samples);
    values.biased[n] = rays.attenuation(points[n], samples, &bias);
    std::array<double, 4> corner{};
    for (std::size_t c = 0; c < 4; ++c) {
      const double depth = std::min(quads[n].depth, functions[n].domain_end[c]);
      corner[c] = rays.attenuation(point_on_ray(view, quads[n].texel[c], depth), samples, &bias);
    }
    values.filtered[n] = quads[n].mix(corner);
  }
  return values;
}

}  // namespace pdsm
