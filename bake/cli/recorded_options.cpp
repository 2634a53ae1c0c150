// SPDX-License-Identifier: Apache-2.0
#include "cli/recorded_options.h"

#include <array>
#include <nlohmann/json.hpp>

#include "cli/inputs.h"
#include "scene/scene_channels.h"

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

Walk walk_of(const std::string& name) {
  if (name == "exact") return Walk::exact;
  if (name == "midpoint") return Walk::midpoint;
  throw std::invalid_argument(name);
}

Receivers receivers_of(const std::string& name) {
  if (name == "all") return Receivers::all;
  if (name == "volume") return Receivers::volume;
  if (name == "surfaces") return Receivers::surfaces;
  throw std::invalid_argument(name);
}

PointSet points_of(const std::string& name) {
  if (name == "lattice") return PointSet::lattice;
  if (name == "jittered") return PointSet::jittered;
  throw std::invalid_argument(name);
}

/// As bake_metadata() wrote them. Throws std::exception on anything else.
BakeOptions parse_options(const Json& metadata, bool has_several_views) {
  const Json& json = metadata.at("options");
  BakeOptions options;
  options.samples = json.at("samples").get<std::uint32_t>();
  const auto size = json.at("resolution").get<std::array<std::uint32_t, 2>>();
  const auto map_size = json.at("map_resolution").get<std::array<std::uint32_t, 2>>();
  options.width = size[0];
  options.height = size[1];
  options.map_width = map_size[0];
  options.map_height = map_size[1];
  options.epsilon = json.at("epsilon").get<double>();
  options.walk = walk_of(json.at("walk").get<std::string>());
  options.receivers = receivers_of(json.at("receivers").get<std::string>());
  options.points = points_of(json.at("points").get<std::string>());
  options.mip_levels = json.at("mip_levels").get<std::uint32_t>();
  options.seed = json.at("seed").get<std::uint64_t>();
  // Each of several views has its own where none was asked for.
  const Json& lengths = has_several_views ? json : metadata;
  if (!has_several_views || json.contains("depth_tolerance"))
    options.depth_tolerance = lengths.at("depth_tolerance").get<double>();
  if (!has_several_views || json.contains("bias")) options.bias = lengths.at("bias").get<double>();
  return options;
}

}  // namespace

std::optional<BakeOptions> recorded_options(const PenumbraMap& map, const Light& light) {
  BakeOptions options;
  try {
    options = parse_options(metadata_of(map), map.views.size() > 1);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  // A map of a coloured light tells the samples of red.
  const Light sampled = channel_light(light, 0);
  const bool own_samples =
      make_light_samples(sampled, options.samples, options.points, options.seed) != map.samples;
  if (own_samples) options.light_samples = map.samples;
  return map.samples.empty() ? std::nullopt : std::optional(options);
}

}  // namespace pdsm
