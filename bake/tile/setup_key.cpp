// SPDX-License-Identifier: Apache-2.0
#include "tile/setup_key.h"

#include <fmt/format.h>

#include <span>

namespace pdsm {
namespace {

/// To be raised when the same inputs give other bytes, and neither tool version nor file format tells.
constexpr std::uint32_t kBytesRevision = 2;

/// What marks that the light has a picture: no light without one runs into the same bytes.
constexpr std::uint64_t kPictureFollows = 0x65727574636970U;

/// What marks that the light has several views; their number is added.
constexpr std::uint64_t kFacesFollow = 0x7365636166647000U;

void add_light(KeyHash& hash, const Light& light) {
  hash.add(light.name);
  hash.add(light.shape.index());
  if (const auto* sun = std::get_if<DistantLight>(&light.shape)) hash.add(sun->angle);
  for (const double extent : half_extents(light)) hash.add(extent);
  if (std::holds_alternative<MeshLight>(light.shape)) hash.add(half_box(light)[2]);
  for (int axis = 0; axis < 3; ++axis) hash.add(light.position[axis]);
  if (view_count(light) > 1) hash.add(kFacesFollow + view_count(light));
  // What a picture holds shows in the samples; that there is one, in what is told of the map.
  if (light.emission) hash.add(kPictureFollows);
}

/// What marks one of several channels; its number is added.
constexpr std::uint64_t kChannelFollows = 0x6c656e6e61686300U;

void add_view(KeyHash& hash, const FittedView& fitted) {
  const View& view = fitted.view;
  hash.add(std::span(view.world_to_view.rotation));
  hash.add(std::span(view.world_to_view.translation));
  hash.add(view.projection);
  hash.add(std::span(view.window));
  hash.add(view.near_depth);
  hash.add(view.far_depth);
  hash.add(view.width);
  hash.add(view.height);
  hash.add(fitted.window_fitted);
  hash.add(fitted.near_fitted);
  hash.add(fitted.far_fitted);
  hash.add(fitted.nothing_casts);
}

/// With defaults resolved: asking for what would have been taken anyway is the same.
void add_options(KeyHash& hash, const BakeSetup& setup) {
  const BakeOptions& options = setup.options;
  hash.add(options.samples);
  for (const GridRatio& ratio : setup.grid.ratio) {
    hash.add(ratio.fine);
    hash.add(ratio.coarse);
  }
  hash.add(options.epsilon);
  hash.add(setup.rules.tolerance);
  hash.add(setup.rules.tolerance_codes);
  hash.add(setup.bias);
  hash.add(options.walk);
  hash.add(options.receivers);
  hash.add(options.points);
  hash.add(options.seed);
  hash.add(setup.mip_levels);
  hash.add(options.unrounded_values);
  if (setup.light_space.has_translucency()) hash.add(setup.rules.transmittance_unit);
}

void add_samples(KeyHash& hash, const std::vector<LightSample>& samples) {
  hash.add(std::uint64_t{samples.size()});
  for (const LightSample& sample : samples) {
    hash.add(std::span(sample.position));
    hash.add(std::span(sample.jitter));
    hash.add(sample.weight);
  }
}

/// What marks that a mask follows: no meshes without one run into the same bytes.
constexpr std::uint64_t kMaskFollows = 0x6b73616d736d6473U;

/// What marks that a mask blends, and that an opacity follows.
constexpr std::uint64_t kMaskBlends = 0x73646e656c626d73U, kOpacityFollows = 0x797469636170736fU;

void add_mask(KeyHash& hash, const LightSpaceMesh& mesh) {
  static_assert(sizeof(glm::vec2) == 2 * sizeof(float));
  hash.add(kMaskFollows);
  hash.add(std::span(mesh.mask_places));
  hash.add(mesh.mask->width);
  hash.add(mesh.mask->height);
  hash.add(std::span(mesh.mask->alpha));
  hash.add(std::span(mesh.mask->wrap));
  hash.add(mesh.mask->cutoff);
  if (mesh.mask->blends) hash.add(kMaskBlends);
}

void add_scene(KeyHash& hash, const LightSpaceScene& scene) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float) && sizeof(glm::uvec3) == 3 * sizeof(std::uint32_t));
  hash.add(std::uint64_t{scene.meshes.size()});
  for (const LightSpaceMesh& mesh : scene.meshes) {
    hash.add(mesh.casts);
    hash.add(mesh.receives);
    hash.add(mesh.closed);
    hash.add(std::span(mesh.positions));
    hash.add(std::span(mesh.triangles));
    if (mesh.mask) add_mask(hash, mesh);
    if (!mesh.is_translucent_caster()) continue;
    hash.add(kOpacityFollows);
    hash.add(mesh.opacity);
  }
}

/// What marks that volumes follow.
constexpr std::uint64_t kVolumesFollow = 0x73656d756c6f7673U;

/// Nothing where there are none.
void add_volumes(KeyHash& hash, const BakeSetup& setup) {
  const LightSpaceScene& scene = setup.light_space;
  if (scene.volumes.empty()) return;
  hash.add(kVolumesFollow);
  hash.add(std::uint64_t{scene.volumes.size()});
  hash.add(setup.volume_steps);
  hash.add(setup.rules.transmittance_unit);
  for (const LightSpaceVolume& volume : scene.volumes) {
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) hash.add(volume.light_to_index[column][row]);
    hash.add(volume.extinction);
    hash.add(std::uint64_t{volume.grid->bricks.size()});
    for (const DensityBrick& brick : volume.grid->bricks) {
      for (int axis = 0; axis < 3; ++axis) hash.add(brick.first[axis]);
      hash.add(std::span(brick.density));
    }
  }
}

/// What marks that curves follow.
constexpr std::uint64_t kCurvesFollow = 0x7365767275637f73U;

/// Nothing where there are none.
void add_curves(KeyHash& hash, const LightSpaceScene& scene) {
  if (scene.curves.empty()) return;
  static_assert(sizeof(glm::vec4) == 4 * sizeof(float));
  hash.add(kCurvesFollow);
  hash.add(std::uint64_t{scene.curves.size()});
  for (const LightSpaceCurves& curves : scene.curves) {
    hash.add(curves.shape);
    hash.add(std::span(curves.points));
    hash.add(std::span(curves.segments));
  }
}

}  // namespace

void add_setup(KeyHash& hash, const BakeSetup& setup, const Light& light, const std::string& isa,
               const std::string& version) {
  hash.add(kBytesRevision);
  hash.add(kFormatMajor);
  hash.add(kFormatMinor);
  hash.add(version);
  hash.add(isa);
  add_light(hash, light);
  if (setup.channels > 1) hash.add(kChannelFollows + setup.part.channel);
  add_view(hash, setup.fitted);
  add_options(hash, setup);
  add_samples(hash, setup.light_samples);
}

std::string setup_key(const BakeSetup& setup, const Light& light, const std::string& isa,
                      const std::string& version) {
  const BakeSetup* views[] = {&setup};
  return setup_key(views, light, isa, version);
}

std::string setup_key(std::span<const BakeSetup* const> views, const Light& light, const std::string& isa,
                      const std::string& version) {
  KeyHash hash;
  for (const BakeSetup* setup : views) {
    add_setup(hash, *setup, light, isa, version);
    add_scene(hash, setup->light_space);
    add_volumes(hash, *setup);
    add_curves(hash, setup->light_space);
  }
  const auto [high, low] = hash.digest();
  return fmt::format("{:016x}{:016x}", high, low);
}

}  // namespace pdsm
