// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/measurement.h"

#include <nlohmann/json.hpp>

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

Json setting_json(const TradeoffSetting& s) {
  return {{"samples", s.samples},     {"resolution", {s.width, s.height}},
          {"map_scale", s.map_scale}, {"walk", s.walk == Walk::exact ? "exact" : "midpoint"},
          {"epsilon", s.epsilon},     {"light_scale", s.light_scale}};
}

TradeoffSetting setting_from(const Json& json) {
  TradeoffSetting s;
  s.samples = json.at("samples").get<std::uint32_t>();
  s.width = json.at("resolution").at(0).get<std::uint32_t>();
  s.height = json.at("resolution").at(1).get<std::uint32_t>();
  s.map_scale = json.at("map_scale").get<double>();
  s.walk = json.at("walk").get<std::string>() == "exact" ? Walk::exact : Walk::midpoint;
  s.epsilon = json.at("epsilon").get<double>();
  s.light_scale = json.at("light_scale").get<double>();
  return s;
}

Json error_json(const VerifyResult& e) {
  return {{"points", e.points},
          {"surface_points", e.surface_points},
          {"buried_points", e.buried},
          {"shadowed_points", e.shadowed_points},
          {"past_end", e.past_end},
          {"mean_abs_error", e.mean_abs_error},
          {"surface_error", e.surface_error},
          {"free_error", e.free_error},
          {"rms_error", e.rms_error},
          {"p99_error", e.p99_error},
          {"max_error", e.max_error},
          {"bias", e.bias},
          {"truth_standard_error", e.truth_standard_error}};
}

VerifyResult error_from(const Json& json) {
  VerifyResult e;
  e.points = json.at("points").get<std::uint64_t>();
  e.surface_points = json.at("surface_points").get<std::uint64_t>();
  e.buried = json.at("buried_points").get<std::uint64_t>();
  e.shadowed_points = json.at("shadowed_points").get<std::uint64_t>();
  e.past_end = json.at("past_end").get<std::uint64_t>();
  e.mean_abs_error = json.at("mean_abs_error").get<double>();
  e.surface_error = json.at("surface_error").get<double>();
  e.free_error = json.at("free_error").get<double>();
  e.rms_error = json.at("rms_error").get<double>();
  e.p99_error = json.at("p99_error").get<double>();
  e.max_error = json.at("max_error").get<double>();
  e.bias = json.at("bias").get<double>();
  e.truth_standard_error = json.at("truth_standard_error").get<double>();
  return e;
}

}  // namespace

Json to_json(const Measurement& m) {
  return {{"setting", setting_json(m.setting)},
          {"seconds", m.seconds},
          {"cpu_seconds", m.cpu_seconds},
          {"rays", m.rays},
          {"events", m.events},
          {"pieces", m.pieces},
          {"bytes", {{"file", m.file_bytes}, {"gpu", m.gpu_bytes}}},
          {"error", error_json(m.error)},
          {"tube",
           {{"functions", m.tube.functions},
            {"outside", m.tube.outside},
            {"worst_margin", m.tube.worst_margin}}}};
}

Measurement measurement_of(const Json& json) {
  Measurement m;
  m.setting = setting_from(json.at("setting"));
  m.seconds = json.at("seconds").get<double>();
  m.cpu_seconds = json.at("cpu_seconds").get<double>();
  m.rays = json.at("rays").get<std::uint64_t>();
  m.events = json.at("events").get<std::uint64_t>();
  m.pieces = json.at("pieces").get<std::uint64_t>();
  m.file_bytes = json.at("bytes").at("file").get<std::uint64_t>();
  m.gpu_bytes = json.at("bytes").at("gpu").get<std::uint64_t>();
  m.error = error_from(json.at("error"));
  const Json& tube = json.at("tube");
  m.tube.functions = tube.at("functions").get<std::uint64_t>();
  m.tube.outside = tube.at("outside").get<std::uint64_t>();
  m.tube.worst_margin = tube.at("worst_margin").get<double>();
  return m;
}

}  // namespace pdsm
