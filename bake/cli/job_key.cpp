// SPDX-License-Identifier: Apache-2.0
#include "cli/job_key.h"

#include "cli/goal_record.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

Json fixed_json(const FixedOptions& fixed) {
  return {fixed.samples, fixed.resolution, fixed.epsilon, fixed.map_resolution};
}

}  // namespace

JobKey job_key(const BakeCommand& command, const Scene& scene, const MapJob& job) {
  if (!command.goals.any()) return {map_key(scene, *job.light, job.options), {}};
  BakeOptions options = job.options;
  // Nothing is left out of the scene for samples of one's own.
  options.light_samples = make_light_samples(*job.light, options.samples, options.points, options.seed);
  JobKey key{map_key(scene, *job.light, options), asked_json(command.goals)};
  key.asked["fixed"] = fixed_json(fixed_options(command));
  key.asked["key"] = key.map.key;
  return key;
}

std::optional<std::string> up_to_date_key(const JobKey& key, const std::filesystem::path& path) {
  const std::optional<std::string> metadata = read_metadata(path);
  if (!metadata) return std::nullopt;
  // A file of unknown origin may nest until comparing overflows the stack.
  constexpr int kDeepest = 16;
  const auto keep = [](int depth, Json::parse_event_t, Json&) { return depth <= kDeepest; };
  const Json recorded = Json::parse(*metadata, keep, false);
  if (!recorded.is_object() || !recorded.contains("key") || !recorded["key"].is_string()) return std::nullopt;
  const auto text = recorded["key"].get<std::string>();
  const Json asked = recorded.value("asked", Json());
  const bool same = asked == key.asked && (!key.asked.is_null() || text == key.map.key);
  return same ? std::optional(text) : std::nullopt;
}

}  // namespace pdsm
