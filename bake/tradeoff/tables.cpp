// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tradeoff/front.h"

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

/// The measurements of the light at its own size, as choices by one cost.
struct Choices {
  std::vector<const Measurement*> of;
  std::vector<Choice> choices;

  [[nodiscard]] const Measurement* best_within_cost_of(const Measurement& m) const {
    const auto at = static_cast<std::size_t>(std::find(of.begin(), of.end(), &m) - of.begin());
    return of[best_within(choices, choices[at].cost)];
  }
};

double seconds_of(const Measurement& m) {
  return m.cpu_seconds;
}
double file_bytes_of(const Measurement& m) {
  return static_cast<double>(m.file_bytes);
}
double gpu_bytes_of(const Measurement& m) {
  return static_cast<double>(m.gpu_bytes);
}

Choices choices_by(const Sweep& sweep, double (*cost)(const Measurement&)) {
  Choices choices;
  for (const Measurement& m : sweep.measurements) {
    if (m.setting.light_scale != 1) continue;
    choices.of.push_back(&m);
    choices.choices.push_back({cost(m), m.error.mean_abs_error});
  }
  return choices;
}

/// Marks those on the front of error and `cost`.
void mark_front(const Sweep& sweep, std::vector<Standing>& standings, bool Standing::*mark,
                double (*cost)(const Measurement&)) {
  const Choices choices = choices_by(sweep, cost);
  const std::vector<bool> front = pareto_front(choices.choices);
  for (std::size_t n = 0; n < front.size(); ++n) {
    const auto index = static_cast<std::size_t>(choices.of[n] - sweep.measurements.data());
    standings[index].*mark = front[n];
  }
}

}  // namespace

std::vector<Standing> find_standings(const Sweep& sweep) {
  std::vector<Standing> standings(sweep.measurements.size());
  for (std::size_t n = 0; n < standings.size(); ++n) {
    for (const NamedSetting& named : sweep.plan.named) {
      if (named.setting != sweep.measurements[n].setting) continue;
      standings[n].name += (standings[n].name.empty() ? "" : " / ") + named.name;
    }
  }
  mark_front(sweep, standings, &Standing::on_time_front, seconds_of);
  mark_front(sweep, standings, &Standing::on_file_front, file_bytes_of);
  mark_front(sweep, standings, &Standing::on_gpu_front, gpu_bytes_of);
  return standings;
}

std::string csv_of(const Sweep& sweep, const std::vector<Standing>& standings) {
  std::string csv =
      "name,samples,width,height,map_scale,walk,epsilon,light_scale,seconds,cpu_seconds,rays,events,pieces,"
      "file_bytes,"
      "gpu_bytes,mean_abs_error,surface_error,free_error,rms_error,p99_error,max_error,bias,"
      "truth_standard_error,points,shadowed_points,past_end,tube_functions,tube_outside,tube_worst_margin,"
      "time_front,file_front,gpu_front\n";
  for (std::size_t n = 0; n < sweep.measurements.size(); ++n) {
    const Measurement& m = sweep.measurements[n];
    const TradeoffSetting& s = m.setting;
    const VerifyResult& e = m.error;
    csv += fmt::format("\"{}\",{},{},{},{},{},{},{},{:.4f},{:.4f},{},{},{},{},{}", standings[n].name,
                       s.samples, s.width, s.height, s.map_scale,
                       s.walk == Walk::exact ? "exact" : "midpoint", s.epsilon, s.light_scale, m.seconds,
                       m.cpu_seconds, m.rays, m.events, m.pieces, m.file_bytes, m.gpu_bytes);
    csv += fmt::format(",{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{}", e.mean_abs_error,
                       e.surface_error, e.free_error, e.rms_error, e.p99_error, e.max_error, e.bias,
                       e.truth_standard_error, e.points, e.shadowed_points, e.past_end);
    csv +=
        fmt::format(",{},{},{:.3e},{:d},{:d},{:d}\n", m.tube.functions, m.tube.outside, m.tube.worst_margin,
                    standings[n].on_time_front, standings[n].on_file_front, standings[n].on_gpu_front);
  }
  return csv;
}

Json json_of(const Scene& scene, const Sweep& sweep, const std::vector<Standing>& standings,
             const SweepOptions& options) {
  Json json;
  json["scene"] = scene.source;
  json["input_hash"] = fmt::format("{:016x}", scene.content_hash);
  json["light"] = sweep.light.name;
  json["points"] = sweep.points;
  json["truth_samples"] = options.verify.samples;
  json["measurements"] = Json::array();
  for (std::size_t n = 0; n < sweep.measurements.size(); ++n) {
    Json entry = to_json(sweep.measurements[n]);
    entry["name"] = standings[n].name;
    entry["front"] = {{"seconds", standings[n].on_time_front},
                      {"file_bytes", standings[n].on_file_front},
                      {"gpu_bytes", standings[n].on_gpu_front}};
    json["measurements"].push_back(entry);
  }
  return json;
}

std::vector<NamedStanding> named_standings(const Sweep& sweep) {
  const Choices by_time = choices_by(sweep, seconds_of), by_file = choices_by(sweep, file_bytes_of);
  std::vector<NamedStanding> standings;
  for (const NamedSetting& named : sweep.plan.named) {
    const auto found = std::find_if(sweep.measurements.begin(), sweep.measurements.end(),
                                    [&](const Measurement& m) { return m.setting == named.setting; });
    const Measurement& m = *found;
    standings.push_back({named.name, &m, by_time.best_within_cost_of(m), by_file.best_within_cost_of(m)});
  }
  return standings;
}

TubeCheck total_tube(const Sweep& sweep) {
  TubeCheck total;
  for (const Measurement& m : sweep.measurements) {
    TubeCheck check = m.tube;
    // A bake without loss stands on its walls.
    if (m.setting.epsilon == 0 && check.outside == 0) check.worst_margin = total.worst_margin;
    total.add(check);
  }
  return total;
}

}  // namespace pdsm
