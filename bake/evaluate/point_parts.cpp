// SPDX-License-Identifier: Apache-2.0
#include "evaluate/point_parts.h"

#include <algorithm>
#include <functional>

#include "evaluate/quad_answers.h"
#include "evaluate/sample_rays.h"
#include "evaluate/texel_quad.h"
#include "fit/fit_rules.h"
#include "pdsm/format/error.h"
#include "pdsm/runtime/look_up.h"
#include "tile/bake_blocks.h"
#include "trace/volume_steps.h"

namespace pdsm {
namespace {

/// The map's bake without fit: every event where it is, on all depths. Translucent casters take away what is
/// no count of samples, so that theirs is next to it.
BakeOptions without_fit(const Scene& scene, BakeOptions options, std::uint32_t samples) {
  const bool has_volumes =
      std::ranges::any_of(scene.volumes, [](const Volume& volume) { return casts_shadows(volume); });
  // The volumes' steps stay the map's.
  if (has_volumes && options.volume_steps == 0)
    options.volume_steps = choose_volume_steps(options.epsilon, samples);
  const bool lossy = has_volumes || std::ranges::any_of(scene.geometry, is_translucent_caster);
  options.epsilon = lossy ? kLeastLossyEpsilon : 0;
  options.depth_tolerance = 0;
  options.mip_levels = 0;
  if (options.receivers == Receivers::surfaces) options.receivers = Receivers::volume;
  return options;
}

/// The map's bake without rounding of values.
BakeOptions without_rounding(BakeOptions options) {
  options.mip_levels = 0;
  options.unrounded_values = true;
  return options;
}

/// Bakes again and asks. Nothing of the map is kept, so that it may be large.
QuadAnswers ask_bake(const BakeJob& job, std::span<const TexelQuad> quads) {
  QuadAnswers answers(job.fitted.view, job.rules.coding, quads);
  bake_blocks(job, [&answers](FittedBlock&& block) { answers.see(block.index, block.levels.front()); });
  return answers;
}

/// Whether the bake is one of the map's view from its samples.
void check_same(const PenumbraMap& map, const BakeJob& job) {
  if (map.views.front() != job.fitted.view) {
    throw Error(Failure::input, "error budget", "the map's view is not what this scene and light give");
  }
  if (map.samples != job.samples) {
    throw Error(Failure::input, "error budget", "the map's light samples are not what its options give");
  }
}

/// Whether the map's values are counts, which rounding leaves alone. Only epsilon decides.
bool has_exact_values(const PenumbraMap& map, const BakeOptions& options) {
  const auto count = static_cast<std::uint32_t>(map.samples.size());
  return make_fit_rules(map.views.front(), count, options.epsilon, 0).constant_pieces;
}

std::vector<double> look_up_all(const PenumbraMap& map, std::span<const glm::dvec3> points) {
  const PenumbraLookUp look_up(map);
  std::vector<double> values;
  values.reserve(points.size());
  for (const glm::dvec3& p : points)
    values.push_back(static_cast<double>(look_up.at({p.x, p.y, p.z}, Filter::bilinear).attenuation));
  return values;
}

/// later - earlier, point by point.
std::vector<double> change(const std::vector<double>& earlier, const std::vector<double>& later) {
  std::vector<double> changes(earlier.size());
  std::transform(later.begin(), later.end(), earlier.begin(), changes.begin(), std::minus<>());
  return changes;
}

}  // namespace

PointParts measure_point_parts(const PenumbraMap& map, const Scene& scene, const Light& light,
                               const BakeOptions& options, const ProbedTruth& truth) {
  std::vector<TexelQuad> quads;
  for (const glm::dvec3& p : truth.points) quads.push_back(quad_at(map.views.front(), p));
  const std::vector<double> looked_up = look_up_all(map, truth.points);

  std::vector<double> unfitted, unrounded = looked_up;
  SampleRayValues rays;
  {
    const BakeJob job(scene, light,
                      without_fit(scene, options, static_cast<std::uint32_t>(map.samples.size())));
    check_same(map, job);
    const QuadAnswers answers = ask_bake(job, quads);
    unfitted = answers.mixed();
    rays = trace_sample_rays(scene, light, job, truth.points, quads, answers.functions());
  }
  if (!has_exact_values(map, options))
    unrounded = ask_bake(BakeJob(scene, light, without_rounding(options)), quads).mixed();

  PointParts parts;
  const std::vector<double> whole_light = truth.values();
  parts.sampling = change(whole_light, rays.at_point);
  parts.filter = change(rays.at_point, rays.filtered);
  parts.map = change(rays.filtered, unfitted);
  parts.fit = change(unfitted, unrounded);
  parts.quantisation = change(unrounded, looked_up);
  parts.total = change(whole_light, looked_up);
  parts.depth_bias = change(rays.at_point, rays.biased);
  return parts;
}

}  // namespace pdsm
