// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <string>

#include "evaluate/colour.h"
#include "ui/panels.h"

namespace pdsm {
namespace {

ImU32 packed(const glm::vec3& colour) {
  return ImGui::ColorConvertFloat4ToU32({colour.r, colour.g, colour.b, 1});
}

/// The heat colours from 0 to `top` with five numbers below.
void draw_bar(float width, double top) {
  constexpr int kBands = 128, kTicks = 4;
  const float height = ImGui::GetFontSize() * 0.8F;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (int i = 0; i < kBands; ++i) {
    const auto edge = [&](int band) { return corner.x + width * static_cast<float>(band) / kBands; };
    const ImU32 left = packed(heat_colour(i / static_cast<double>(kBands)));
    const ImU32 right = packed(heat_colour((i + 1) / static_cast<double>(kBands)));
    list.AddRectFilledMultiColor({edge(i), corner.y}, {edge(i + 1), corner.y + height}, left, right, right,
                                 left);
  }
  for (int i = 0; i <= kTicks; ++i) {
    const std::string label = fmt::format("{:.3g}", top * i / kTicks);
    const float x = corner.x + width * static_cast<float>(i) / kTicks;
    const float half = 0.5F * ImGui::CalcTextSize(label.c_str()).x;
    list.AddText({x - half, corner.y + height + 3}, ImGui::GetColorU32(ImGuiCol_TextDisabled), label.c_str());
  }
  ImGui::Dummy({width, height + ImGui::GetFontSize() + 4});
}

void show_error_numbers(const UiState& state) {
  const DifferenceSummary& error = state.error;
  ImGui::TextUnformatted("|map - truth|");
  ImGui::SameLine(0, 16);
  ImGui::TextUnformatted(
      fmt::format("mean {:.4f}   rms {:.4f}   max {:.3f}", error.mean_abs, error.rms, error.max).c_str());
  ImGui::SameLine(0, 16);
  ImGui::TextDisabled("%s", fmt::format("{} pixels", error.pixels).c_str());
}

}  // namespace

void show_colour_scale(const UiState& state) {
  const bool error = state.settings.mode == Mode::error && state.truth_ready;
  if (!error && state.settings.mode != Mode::slice) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5F * display.x + 10.5F * ImGui::GetFontSize(), display.y - 14}, ImGuiCond_Always,
                          {0.5F, 1});
  ImGui::Begin("##scale", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  if (error) {
    show_error_numbers(state);
  } else {
    ImGui::TextUnformatted("fraction of the light that is blocked");
  }
  ImGui::Dummy({4, 0});
  ImGui::SameLine();
  draw_bar(26 * ImGui::GetFontSize(), error ? static_cast<double>(state.error_top) : 1.0);
  ImGui::End();
}

}  // namespace pdsm
