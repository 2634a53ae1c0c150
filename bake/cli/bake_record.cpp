// SPDX-License-Identifier: Apache-2.0
#include "cli/bake_record.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/goal_record.h"
#include "cli/inputs.h"
#include "evaluate/map_statistics.h"
#include "level/light_json.h"
#include "pdsm/bake/map_key.h"
#include "pdsm/format/atomic_file.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

Json modelled_json(const BakeReport& report) {
  Json list = Json::array();
  for (const ModelledFeature& feature : report.modelled) {
    list.push_back(
        {{"feature", feature.feature}, {"modelled", feature.modelled}, {"reason", feature.reason}});
    if (!feature.saved.empty()) list.back()["saved"] = feature.saved;
  }
  return list;
}

const char* receivers_name(Receivers receivers) {
  switch (receivers) {
    case Receivers::all:
      return "all";
    case Receivers::surfaces:
      return "surfaces";
    case Receivers::volume:
      break;
  }
  return "volume";
}

Json options_json(const BakeOptions& options, const BakeReport& report) {
  return {{"samples", report.samples},
          {"resolution", {options.width, options.height}},
          {"map_resolution", {report.map_width, report.map_height}},
          {"epsilon", options.epsilon},
          {"walk", walk_name(options.walk)},
          {"receivers", receivers_name(options.receivers)},
          {"points", options.points == PointSet::lattice ? "lattice" : "jittered"},
          {"mip_levels", report.mip_levels},
          {"seed", options.seed}};
}

Json fit_json(const FittedView& fitted) {
  return {{"window_fitted", fitted.window_fitted},
          {"near_fitted", fitted.near_fitted},
          {"far_fitted", fitted.far_fitted},
          {"nothing_casts", fitted.nothing_casts}};
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

const char* walk_name(Walk walk) {
  return walk == Walk::midpoint ? "midpoint" : "exact";
}

std::string bake_metadata(const Light& light, const BakeOptions& options, const BakedMap& baked,
                          const ChosenBake* chosen, const Json& asked) {
  const BakeReport& report = baked.report;
  Json json;
  json["tool"] = {{"name", "pdsm"}, {"version", kToolVersion}};
  json["key"] = report.key;
  json["isa"] = report.isa;
  json["light"] = light_json(light);
  json["options"] = options_json(options, report);
  // Each of several views has its own where none is asked for.
  if (baked.map.views.size() > 1 && options.bias) json["options"]["bias"] = *options.bias;
  if (baked.map.views.size() > 1 && options.depth_tolerance)
    json["options"]["depth_tolerance"] = *options.depth_tolerance;
  json["view_fit"] = fit_json(baked.fitted);
  json["epsilon"] = report.epsilon;
  json["depth_tolerance"] = report.depth_tolerance;
  json["bias"] = report.bias;
  if (!asked.is_null()) json["asked"] = asked;
  if (chosen != nullptr) json["achieved"] = achieved_json(*chosen);
  json["modelled"] = modelled_json(report);
  return text_of(json);
}

std::string with_modelled(const PenumbraMap& map, const BakeReport& report) {
  Json json = metadata_of(map);
  if (!json.is_object()) throw Error(Failure::input, "metadata", "must be a JSON object");
  json["modelled"] = modelled_json(report);
  return text_of(json);
}

void write_report(const std::filesystem::path& path, const nlohmann::ordered_json& report) {
  const std::string text = report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  AtomicFile file(path);
  file.write(std::as_bytes(std::span(text)));
  file.commit();
}

nlohmann::ordered_json bake_report(const BakeOptions& options, const BakedMap& baked, const BakeCosts& costs,
                                   const ChosenBake* chosen) {
  const BakeReport& report = baked.report;
  Json json;
  json["seconds"] = {{"load", costs.seconds_load},
                     {"bvh", report.seconds_bvh},
                     {"trace", report.seconds_trace},
                     {"walk", report.seconds_walk},
                     {"accumulate", report.seconds_accumulate},
                     {"fit", report.seconds_fit},
                     {"write", costs.seconds_write},
                     {"total", costs.seconds_load + report.seconds_total + costs.seconds_write}};
  json["rays"] = report.rays;
  json["events"] = report.events;
  json["texels"] = report.texels;
  json["pieces"] = report.pieces;
  json["blocks"] = report.blocks;
  json["blocks_taken_over"] = report.blocks_taken_over;
  json["bytes"] = {{"file", costs.file_bytes},
                   {"gpu", texture_bytes(baked)},
                   {"peak_memory", peak_memory()},
                   {"resident_after_bvh", report.resident_after_bvh}};
  json["samples"] = report.samples;
  json["resolution"] = {options.width, options.height};
  json["mip_levels"] = report.mip_levels;
  json["epsilon"] = report.epsilon;
  json["depth_tolerance"] = report.depth_tolerance;
  json["bias"] = report.bias;
  json["walk"] = walk_name(report.walk);
  json["isa"] = report.isa;
  json["modelled"] = modelled_json(report);
  json["receivers_outside"] = baked.fitted.receivers_outside;
  if (chosen != nullptr) json["goal"] = goal_json(*chosen);
  return json;
}

std::uint64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t kilobytes = 0;
    if (word == "VmHWM:" && status >> kilobytes) return kilobytes * 1024;
  }
  return 0;
}

}  // namespace pdsm
