// SPDX-License-Identifier: Apache-2.0
#include "part/bake_identity.h"

#include <xxhash.h>

#include <memory>
#include <new>
#include <span>
#include <string>
#include <type_traits>

namespace pdsm {
namespace {

/// XXH3 of values one after another; what has padding is told member by member.
class Hash {
 public:
  Hash() : state_(XXH3_createState()) {
    if (!state_) throw std::bad_alloc();
    XXH3_64bits_reset(state_.get());
  }

  template <typename T>
  Hash& values(std::span<const T> all) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    one(std::uint64_t{all.size()});
    XXH3_64bits_update(state_.get(), all.data(), all.size_bytes());
    return *this;
  }
  template <typename T>
  Hash& one(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    XXH3_64bits_update(state_.get(), &value, sizeof value);
    return *this;
  }
  Hash& text(const std::string& text) { return values(std::span(text)); }

  [[nodiscard]] std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_;
};

void add_geometry(const Geometry& geometry, Hash& hash) {
  const Mesh& mesh = *geometry.mesh;
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float) && sizeof(glm::uvec3) == 3 * sizeof(std::uint32_t));
  const auto floats = [](const std::vector<glm::vec3>& all) {
    return std::span(reinterpret_cast<const float*>(all.data()), 3 * all.size());
  };
  const auto indices = [](const std::vector<glm::uvec3>& all) {
    return std::span(reinterpret_cast<const std::uint32_t*>(all.data()), 3 * all.size());
  };
  hash.values(floats(mesh.positions)).values(indices(mesh.triangles)).one(mesh.closed);
  hash.values(std::span<const double>(&geometry.local_to_world[0][0], 16));
  hash.one(geometry.casts).one(geometry.receives);
}

void add_view(const FittedView& fitted, Hash& hash) {
  const View& view = fitted.view;
  hash.values<double>(view.world_to_view.rotation).values<double>(view.world_to_view.translation);
  hash.values<double>(view.window).one(view.projection).one(view.near_depth).one(view.far_depth);
  hash.one(view.width).one(view.height).one(fitted.nothing_casts).one(fitted.near_fitted);
}

void add_samples(const std::vector<LightSample>& samples, Hash& hash) {
  hash.one(std::uint64_t{samples.size()});
  for (const LightSample& sample : samples)
    hash.values<double>(sample.position).values<float>(sample.jitter).one(sample.weight);
}

void add_options(const BakeJob& job, Hash& hash) {
  const BakeOptions& options = job.options;
  hash.one(options.map_width).one(options.map_height).one(options.epsilon);
  hash.one(job.rules.tolerance).one(job.bias).one(options.walk).one(options.receivers);
  hash.one(job.mip_levels).one(options.unrounded_values).one(options.light_samples.empty());
}

}  // namespace

std::uint64_t bake_identity(const Scene& scene, const BakeJob& job) {
  Hash hash;
  hash.text(PDSM_VERSION).text(job.options.isa);
  hash.one(std::uint64_t{scene.geometry.size()});
  for (const Geometry& geometry : scene.geometry) add_geometry(geometry, hash);
  add_view(job.fitted, hash);
  add_samples(job.samples, hash);
  add_options(job, hash);
  return hash.digest();
}

}  // namespace pdsm
