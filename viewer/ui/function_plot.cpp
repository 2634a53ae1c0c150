// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ui/panels.h"

namespace pdsm {
namespace {

constexpr ImU32 kCurve = IM_COL32(245, 168, 82, 255), kGrid = IM_COL32(255, 255, 255, 22),
                kSurface = IM_COL32(120, 200, 255, 255), kPastEnd = IM_COL32(0, 0, 0, 90);

/// From depths and attenuations to the window.
class PlotArea {
 public:
  PlotArea(const ImVec2& corner, const ImVec2& size, double low, double high)
      : corner_(corner), size_(size), low_(low), high_(high) {}

  [[nodiscard]] float x(double depth) const {
    const double share = std::clamp((depth - low_) / (high_ - low_), 0.0, 1.0);
    return corner_.x + size_.x * static_cast<float>(share);
  }
  [[nodiscard]] float y(double value) const { return corner_.y + size_.y * static_cast<float>(1 - value); }
  [[nodiscard]] ImVec2 at(double depth, double value) const { return {x(depth), y(value)}; }
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

 private:
  ImVec2 corner_, size_;
  double low_, high_;
};

void draw_grid(ImDrawList& list, const PlotArea& area) {
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  for (const double value : {0.0, 0.5, 1.0}) {
    list.AddLine(area.at(area.low(), value), area.at(area.high(), value), kGrid);
    const std::string label = fmt::format("{:.3g}", value);
    const ImVec2 size = ImGui::CalcTextSize(label.c_str());
    list.AddText({area.x(area.low()) - size.x - 7, area.y(value) - 0.5F * size.y}, ink, label.c_str());
  }
  constexpr int kTicks = 4;
  for (int i = 0; i <= kTicks; ++i) {
    const double depth = area.low() + (area.high() - area.low()) * i / kTicks;
    list.AddLine(area.at(depth, 0), area.at(depth, 1), kGrid);
    const std::string label = fmt::format("{:.2f}{}", depth, i == kTicks ? " m" : "");
    const ImVec2 size = ImGui::CalcTextSize(label.c_str());
    list.AddText({area.x(depth) - 0.5F * size.x, area.y(0) + 5}, ink, label.c_str());
  }
}

/// Pieces, jumps between them, and a dot at each vertex.
void draw_function(ImDrawList& list, const PlotArea& area, const std::vector<ProbeVertex>& function) {
  ImVec2 pen = area.at(area.low(), 0);
  const auto line_to = [&](const ImVec2& point) {
    list.AddLine(pen, point, kCurve, 2);
    pen = point;
  };
  double before = 0;
  for (const ProbeVertex& vertex : function) {
    line_to(area.at(vertex.depth, before));
    line_to(area.at(vertex.depth, vertex.begin));
    before = vertex.end;
  }
  line_to(area.at(area.high(), before));
  for (const ProbeVertex& vertex : function)
    list.AddCircleFilled(area.at(vertex.depth, vertex.begin), 3.5F, kCurve);
}

void draw_surface(ImDrawList& list, const PlotArea& area, const FunctionProbe& probe) {
  const double value = probe_value(probe, probe.point_depth);
  list.AddLine(area.at(probe.point_depth, 0), area.at(probe.point_depth, 1), kSurface, 1.5F);
  list.AddCircle(area.at(probe.point_depth, value), 5.5F, kSurface, 0, 2);
}

/// The depths that a plot shows: where something happens, and the surface, with some room.
std::pair<double, double> shown_depths(const FunctionProbe& probe) {
  double low = probe.point_depth, high = probe.point_depth;
  for (const std::vector<ProbeVertex>& layer : probe.layers) {
    if (layer.empty()) continue;
    low = std::min(low, layer.front().depth);
    high = std::max(high, layer.back().depth);
  }
  if (low == high) return {probe.near_depth, std::max(probe.far_depth, high)};
  const double room = 0.08 * (high - low);
  return {low - room, high + room};
}

void draw_plot(const FunctionProbe& probe) {
  const float unit = ImGui::GetFontSize(), left = 2.2F * unit;
  const ImVec2 size(21 * unit, 9 * unit), corner = ImGui::GetCursorScreenPos();
  const auto [low, high] = shown_depths(probe);
  const PlotArea area({corner.x + left, corner.y + 0.5F * unit}, size, low, high);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (probe.domain_end < high) {
    list.AddRectFilled(area.at(std::max(probe.domain_end, low), 1), area.at(high, 0), kPastEnd);
  }
  draw_grid(list, area);
  for (const std::vector<ProbeVertex>& layer : probe.layers) draw_function(list, area, layer);
  draw_surface(list, area, probe);
  ImGui::Dummy({left + size.x + 1.4F * unit, size.y + 2 * unit});
}

void show_numbers(const FunctionProbe& probe) {
  std::size_t vertices = 0;
  for (const std::vector<ProbeVertex>& layer : probe.layers) vertices += layer.size();
  ImGui::TextDisabled(
      "%s", fmt::format("texel {}, {}   {} vertices", probe.texel[0], probe.texel[1], vertices).c_str());
  ImGui::TextUnformatted(fmt::format("surface at {:.3f} m: {:.3f} blocked", probe.point_depth,
                                     probe_value(probe, probe.point_depth))
                             .c_str());
  if (probe.point_depth > probe.domain_end) {
    ImGui::SameLine();
    ImGui::TextDisabled("(past the end)");
  }
}

}  // namespace

void show_function_plot(const Session& session, UiState& state) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x - 12, display.y - 12}, ImGuiCond_Always, {1, 1});
  ImGui::Begin("##function", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  const std::vector<Light>& lights = session.stage()->scene().lights;
  const std::string light = state.light < lights.size() ? lights[state.light].name : "";
  ImGui::TextUnformatted(fmt::format("Fraction of '{}' blocked, against depth", light).c_str());
  if (state.probe) {
    draw_plot(*state.probe);
    show_numbers(*state.probe);
  } else {
    ImGui::TextDisabled("nothing %s that a map of this light covers",
                        state.pinned ? "at the pin" : "under the cursor");
  }
  if (state.pinned) {
    if (ImGui::SmallButton("unpin")) state.pinned.reset();
  } else {
    ImGui::TextDisabled("click on a surface to pin it");
  }
  ImGui::End();
}

}  // namespace pdsm
