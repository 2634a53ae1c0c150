// SPDX-License-Identifier: Apache-2.0
#include "cli/verify_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

/// One figure of each part.
Json parts_json(const ErrorBudget& budget, double ErrorPart::*figure) {
  return {{"sampling", budget.sampling.*figure},
          {"map", budget.map.*figure},
          {"fit", budget.fit.*figure},
          {"quantisation", budget.quantisation.*figure},
          {"filter", budget.filter.*figure}};
}

Json budget_json(const ErrorBudget& budget) {
  Json json = parts_json(budget, &ErrorPart::rms);
  json["mean_abs"] = parts_json(budget, &ErrorPart::mean_abs);
  json["bias"] = parts_json(budget, &ErrorPart::bias);
  json["depth_bias"] = budget.depth_bias.rms;
  json["root_sum_squares"] = budget.root_sum_squares;
  json["root_sum_squares_ratio"] = budget.ratio();
  json["telescoping_fault"] = budget.telescoping_fault;
  return json;
}

std::string budget_text(const ErrorBudget& budget) {
  std::string text = "error budget          rms      mean abs  bias\n";
  const auto add = [&text](const char* cause, const ErrorPart& part, const char* remark) {
    text += fmt::format("  {:<20}{:.5f}  {:.5f}   {:+.5f}{}\n", cause, part.rms, part.mean_abs, part.bias,
                        remark);
  };
  add("sampling", budget.sampling, "  (with the truth's own error)");
  add("map", budget.map, "");
  add("fit", budget.fit, "");
  add("quantisation", budget.quantisation, "");
  add("filter", budget.filter,
      fmt::format("  (its depth bias alone: rms {:.5f})", budget.depth_bias.rms).c_str());
  text += fmt::format("  root sum squares    {:.5f}  {:.2f} of the rms error\n", budget.root_sum_squares,
                      budget.ratio());
  return text;
}

}  // namespace

nlohmann::ordered_json verify_result_json(const VerifyResult& result) {
  Json json;
  json["points"] = result.points;
  json["shadowed_points"] = result.shadowed_points;
  json["surface_points"] = result.surface_points;
  json["buried_points"] = result.buried;
  json["mean_abs_error"] = result.mean_abs_error;
  json["surface_error"] = result.surface_error;
  json["free_error"] = result.free_error;
  json["rms_error"] = result.rms_error;
  json["p99_error"] = result.p99_error;
  json["max_error"] = result.max_error;
  json["bias"] = result.bias;
  json["truth_standard_error"] = result.truth_standard_error;
  json["past_end"] = result.past_end;
  return json;
}

std::string verify_json(const VerifyReport& report) {
  Json json = verify_result_json(report.result);
  json["atty_error"] = report.atty_error;
  if (report.budget) json["budget"] = budget_json(*report.budget);
  if (report.light) json["budget"]["light"] = report.light->rms;
  return json.dump(2) + "\n";
}

std::string verify_text(const VerifyReport& report) {
  const VerifyResult& result = report.result;
  std::string text = fmt::format(
      "points                {} ({} on surfaces, {} in shadow, {} past the end; {} buried ones left out)\n"
      "mean abs error        {:.5f} (on surfaces {:.5f}, in free space {:.5f})\n"
      "rms error             {:.5f}\n"
      "p99 error             {:.5f}\n"
      "max error             {:.5f}\n"
      "bias                  {:+.5f}\n"
      "truth standard error  {:.5f}\n"
      "Atty et al.'s error   {:.5f}\n",
      result.points, result.surface_points, result.shadowed_points, result.past_end, result.buried,
      result.mean_abs_error, result.surface_error, result.free_error, result.rms_error, result.p99_error,
      result.max_error, result.bias, result.truth_standard_error, report.atty_error);
  if (report.light)
    text += fmt::format("light model           rms {:.5f}, mean abs {:.5f} (with the truth's own error)\n",
                        report.light->rms, report.light->mean_abs);
  return report.budget ? text + budget_text(*report.budget) : text;
}

}  // namespace pdsm
