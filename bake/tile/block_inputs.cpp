// SPDX-License-Identifier: Apache-2.0
#include "tile/block_inputs.h"

#include <omp.h>

#include <algorithm>
#include <limits>
#include <span>

#include "tile/block_grid.h"
#include "tile/block_reach.h"
#include "tile/key_hash.h"
#include "tile/parallel_failure.h"
#include "tile/setup_key.h"
#include "tile/steep_casters.h"
#include "trace/map_rays.h"

namespace pdsm {
namespace {

/// Casters that are asked for together first.
constexpr std::size_t kTogether = 64;

/// All of a caster that maps depend on: its corners, as they are.
std::array<std::uint64_t, 2> hash_caster(const std::array<glm::vec3, 3>& corners) {
  static_assert(sizeof corners == 9 * sizeof(float));
  const XXH128_hash_t hash = XXH3_128bits(corners.data(), sizeof corners);
  return {hash.high64, hash.low64};
}

/// The lists of a part of the scene's casters, by block.
class CasterLists {
 public:
  CasterLists(const BakeJob& job, const BlockReach& reach, const SteepCasters& steep)
      : reach_(reach),
        steep_(steep),
        across_(blocks_along(job.grid.texels[0])),
        lists_(block_count(job.grid)) {}

  void add(const LightSpaceMesh& mesh, const glm::uvec3& t) {
    const std::array<glm::vec3, 3> corners{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const BlockRange range = reach_.of({corners[0], corners[1], corners[2]});
    if (range.empty() || all_are_traced(range)) return;
    const auto hash = hash_caster(corners);
    const bool is_traced =
        mesh.is_cutout_caster() || mesh.is_translucent_caster() || steep_.may_hold(corners);
    for_each_block(range, [&](BlockCasters& block) {
      block.casters.add(hash);
      block.is_traced = block.is_traced || is_traced;
      return true;
    });
  }
  /// Marks the blocks that a volume, or curves, may darken: there is no list of what decides about them.
  void add(const LightSpaceHull& around, double far_depth) {
    const bool holds_light = around.begins_before(kEmitterShare * far_depth);
    if (holds_light)
      for (BlockCasters& block : lists_) block.is_traced = true;
    const LightSpaceMesh& hull = around.surface;
    for (const glm::uvec3& t : hull.triangles)
      for_each_block(reach_.of({hull.positions[t.x], hull.positions[t.y], hull.positions[t.z]}),
                     [](BlockCasters& block) { return block.is_traced = true; });
  }
  /// Whether none of these casters tells anything: they reach no block that might get a key.
  [[nodiscard]] bool may_pass_over(const LightSpaceMesh& mesh, std::span<const glm::uvec3> triangles) {
    glm::vec3 low(std::numeric_limits<float>::infinity()), high = -low;
    for (const glm::uvec3& t : triangles) {
      for (int n = 0; n < 3; ++n) {
        low = glm::min(low, mesh.positions[t[n]]);
        high = glm::max(high, mesh.positions[t[n]]);
      }
    }
    const BlockRange range = reach_.of_box(low, high);
    return range.empty() || all_are_traced(range);
  }
  [[nodiscard]] const std::vector<BlockCasters>& lists() const { return lists_; }

 private:
  /// Calls visit for the blocks of a range until it returns false; tells whether it never did.
  template <typename Visitor>
  bool for_each_block(const BlockRange& range, Visitor&& visit) {
    for (std::uint32_t y = range.y0; y < range.y1; ++y)
      for (std::uint32_t x = range.x0; x < range.x1; ++x)
        if (!visit(lists_[std::size_t{y} * across_ + x])) return false;
    return true;
  }
  /// These blocks get no key, whatever else there is.
  bool all_are_traced(const BlockRange& range) {
    return for_each_block(range, [](const BlockCasters& block) { return block.is_traced; });
  }

  const BlockReach& reach_;
  const SteepCasters& steep_;
  std::uint32_t across_;
  std::vector<BlockCasters> lists_;
};

/// Adds casters [begin, end) of the scene, counted through all meshes.
void add_casters(const LightSpaceScene& scene, std::size_t begin, std::size_t end, CasterLists& lists) {
  std::size_t first = 0;
  for (const LightSpaceMesh& mesh : scene.meshes) {
    if (!mesh.casts) continue;
    const std::size_t last = first + mesh.triangles.size();
    const std::size_t to = std::min(end, last);
    for (std::size_t n = std::max(begin, first); n < to; n += kTogether) {
      const auto some = std::span(mesh.triangles).subspan(n - first, std::min(kTogether, to - n));
      if (lists.may_pass_over(mesh, some)) continue;
      for (const glm::uvec3& t : some) lists.add(mesh, t);
    }
    first = last;
  }
}

std::size_t count_casters(const LightSpaceScene& scene) {
  std::size_t count = 0;
  for (const LightSpaceMesh& mesh : scene.meshes) count += mesh.casts ? mesh.triangles.size() : 0;
  return count;
}

std::vector<BlockCasters> list_casters(const BakeJob& job) {
  const BlockReach reach(job.grid, bound_samples(job.samples),
                         first_caster_depth(job.grid, job.samples.front()));
  const SteepCasters steep(job);
  const std::size_t count = count_casters(job.light_space);
  const std::size_t threads = job.options.threads;
  std::vector<CasterLists> parts(threads, CasterLists(job, reach, steep));
  job.light_space.visit_hulls(
      [&](const LightSpaceHull& hull) { parts.front().add(hull, job.grid.far_depth); });
#pragma omp parallel for schedule(static) num_threads(static_cast <int>(threads))
  for (std::size_t n = 0; n < threads; ++n)
    add_casters(job.light_space, count * n / threads, count * (n + 1) / threads, parts[n]);
  std::vector<BlockCasters> lists = parts.front().lists();
  for (std::size_t n = 1; n < threads; ++n)
    for (std::size_t b = 0; b < lists.size(); ++b) lists[b].append(parts[n].lists()[b]);
  return lists;
}

}  // namespace

bool BlockInputs::are_known(const BakeJob& job) {
  return job.has_shadows() && !job.casters.empty() && !job.face.is_one_of_several && job.channels == 1;
}

BlockInputs::BlockInputs(const BakeJob& job, const Light& light) : casters_(list_casters(job)) {
  KeyHash hash;
  add_setup(hash, job, light, job.options.isa);
  // With samples of their own, casters count from elsewhere on.
  hash.add(!job.options.light_samples.empty());
  hash.add(job.slope_limit.from);
  shared_ = hash.digest();
}

std::array<std::uint64_t, 2> BlockInputs::key(const TileBlock& block) const {
  if (!can_tell(block.index)) return {};
  KeyHash hash;
  hash.add(std::span(shared_));
  hash.add(block.index);
  const ListHash& casters = casters_[block.index].casters;
  hash.add(casters.count());
  hash.add(std::span(casters.sums()));
  hash.add(std::span(block.domain_ends));
  hash.add(std::uint64_t{block.bands.size()});
  for (const auto& bands : block.bands) {
    hash.add(std::uint64_t{bands.size()});
    for (const CodeBand& band : bands) {
      hash.add(band.first);
      hash.add(band.last);
    }
  }
  return hash.digest();
}

std::unique_ptr<BlockInputs> find_block_inputs(const BakeJob& job, const Light& light) {
  const bool is_asked_for = job.options.block_keys || !job.options.previous.empty();
  if (!is_asked_for || !BlockInputs::are_known(job)) return nullptr;
  return std::make_unique<BlockInputs>(job, light);
}

}  // namespace pdsm
