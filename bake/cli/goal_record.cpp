// SPDX-License-Identifier: Apache-2.0
#include "cli/goal_record.h"

#include <nlohmann/json.hpp>

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

Json settings_json(const Settings& settings) {
  Json json = {{"samples", settings.samples}, {"resolution", {settings.width, settings.height}}};
  // Left out where the maps' size was given.
  const std::uint32_t maps = settings.maps_per_texel;
  if (maps != 0) json["map_resolution"] = {maps * settings.width, maps * settings.height};
  json["epsilon"] = settings.epsilon;
  return json;
}

Json trial_json(const Trial& trial) {
  return {{"purpose", trial.purpose},
          {"options", settings_json(trial.settings)},
          {"error", trial.mean_abs_error()},
          {"standard_error", trial.standard_error},
          {"seconds", trial.seconds_bake},
          {"seconds_measure", trial.seconds_measure},
          {"bytes", trial.bytes}};
}

}  // namespace

Json asked_json(const Goals& goals) {
  Json json = Json::object();
  if (goals.target_error) json["target_error"] = *goals.target_error;
  if (goals.time_budget) json["time_budget"] = *goals.time_budget;
  if (goals.size_budget) json["size_budget"] = *goals.size_budget;
  return json;
}

Json achieved_json(const ChosenBake& chosen) {
  const Trial& trial = chosen.chosen;
  return {{"mean_abs_error", trial.mean_abs_error()},
          {"standard_error", trial.standard_error},
          {"points", trial.error.points},
          {"samples", chosen.measured_by.samples},
          {"seed", chosen.measured_by.seed}};
}

Json goal_json(const ChosenBake& chosen) {
  Json tries = Json::array();
  for (const Trial& trial : chosen.trials) tries.push_back(trial_json(trial));
  return {{"asked", asked_json(chosen.goals)},
          {"tries", tries},
          {"chosen", settings_json(chosen.chosen.settings)},
          {"why", chosen.why},
          {"achieved", achieved_json(chosen)},
          {"seconds", {{"predicted", chosen.expected_seconds}, {"actual", chosen.chosen.seconds_bake}}},
          {"error_predicted", chosen.expected_error}};
}

}  // namespace pdsm
