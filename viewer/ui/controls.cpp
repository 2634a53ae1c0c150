// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include <algorithm>
#include <array>

#include "ui/panels.h"

namespace pdsm {
namespace {

constexpr std::array<const char*, 6> kModeLabels{"Shaded", "Visibility", "Ray-traced truth",
                                                 "Error",  "Slice",      "Attenuation function"};

/// A combo whose entries stand for the values 0, 1, ... of an enumeration.
template <typename Choice, std::size_t Count>
void choose(const char* label, Choice& choice, const std::array<const char*, Count>& names) {
  int index = static_cast<int>(choice);
  if (ImGui::Combo(label, &index, names.data(), static_cast<int>(Count))) choice = static_cast<Choice>(index);
}

void show_mode(UiState& state) {
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##mode", kModeLabels[static_cast<std::size_t>(state.settings.mode)])) {
    for (std::size_t i = 0; i < kModeLabels.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      const bool chosen = static_cast<std::size_t>(state.settings.mode) == i;
      if (ImGui::Selectable("##entry", chosen)) state.settings.mode = static_cast<Mode>(i);
      ImGui::SameLine(0, 0);
      ImGui::TextDisabled("%zu ", i + 1);
      ImGui::SameLine(0, 4);
      ImGui::TextUnformatted(kModeLabels[i]);
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
}

void show_slice_controls(UiState& state) {
  Settings& settings = state.settings;
  constexpr std::array<const char*, 4> kAxes{"across x", "across y", "across z", "across the light"};
  choose("plane", settings.slice_axis, kAxes);
  ImGui::SliderFloat("place", &settings.slice_position, 0, 1, "%.3f", ImGuiSliderFlags_AlwaysClamp);
  ImGui::Checkbox("lines at 1/4, 1/2, 3/4", &settings.slice_contours);
}

void show_truth_controls(UiState& state) {
  int samples = static_cast<int>(state.settings.truth_samples);
  if (ImGui::SliderInt("shadow rays", &samples, 16, 4096, "%d",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
    state.settings.truth_samples = static_cast<std::uint32_t>(samples);
  }
  if (!state.truth.fault.empty()) {
    ImGui::TextWrapped("%s", state.truth.fault.c_str());
  } else if (!state.truth_ready) {
    ImGui::TextDisabled("maps, until the camera rests");
  } else if (!state.truth.finished) {
    ImGui::ProgressBar(static_cast<float>(state.truth.done), {-1, 0});
  } else {
    ImGui::TextDisabled("every pixel traced");
  }
}

void show_look_up_controls(UiState& state) {
  if (!ImGui::CollapsingHeader("Look-up", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Settings& settings = state.settings;
  constexpr std::array<const char*, 2> kFilters{"nearest", "bilinear"}, kLayouts{"two-level", "fixed depth"};
  choose("filter", settings.filter, kFilters);
  choose("layout", settings.layout, kLayouts);
  ImGui::SliderFloat("offset", &settings.normal_offset, 0, 4, "%.2f texels", ImGuiSliderFlags_AlwaysClamp);
  ImGui::Checkbox("coarser far away", &settings.use_footprint);
  ImGui::SameLine();
  ImGui::TextDisabled("%.2f MB", static_cast<double>(state.texture_bytes) / 1e6);
}

void show_moving_controls(UiState& state) {
  if (!ImGui::CollapsingHeader("What moves", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Settings& settings = state.settings;
  ImGui::Checkbox("object", &settings.object);
  ImGui::SameLine();
  ImGui::Checkbox("dust", &settings.particles);
  ImGui::SameLine();
  ImGui::Checkbox("fog", &settings.fog);
  ImGui::SameLine();
  ImGui::Checkbox("paused", &settings.paused);
  if (!ImGui::TreeNode("adjust")) return;
  ImGui::SliderFloat("size", &settings.object_size, 0.03F, 0.5F, "%.2f");
  ImGui::SliderFloat("distance", &settings.path_radius, 0, 1.5F, "%.2f");
  ImGui::SliderFloat("height", &settings.path_height, 0, 2, "%.2f");
  ImGui::SliderFloat("fog", &settings.fog_density, 0.05F, 4, "%.2f", ImGuiSliderFlags_Logarithmic);
  ImGui::SliderFloat("fog's top", &settings.fog_height, 0.2F, 3, "%.2f");
  ImGui::TreePop();
}

void show_drawing_controls(UiState& state) {
  if (!ImGui::CollapsingHeader("Drawing", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Settings& settings = state.settings;
  if (ImGui::BeginTable("drawn", 2)) {
    ImGui::TableNextColumn();
    ImGui::Checkbox("lights", &settings.gizmos);
    ImGui::TableNextColumn();
    ImGui::Checkbox("map windows", &settings.frustum);
    ImGui::TableNextColumn();
    ImGui::Checkbox("function plot", &settings.plot);
    ImGui::TableNextColumn();
    ImGui::Checkbox("smooth edges", &settings.antialias);
    ImGui::EndTable();
  }
  if (ImGui::Button("Frame")) state.frame_scene = true;
  ImGui::SameLine();
  if (ImGui::Button("Screenshot")) state.screenshot = true;
  ImGui::SameLine();
  if (ImGui::Button("without panels")) state.screenshot = false;
}

void show_frame_times(const UiState& state) {
  const FrameTimes& times = state.times;
  if (times.filled == 0) return;
  constexpr float kTop = 2.5F;  // medians: what takes longer is cut off
  const float median = std::max(times.median(), 1e-3F);
  ImGui::Separator();
  ImGui::PlotLines("##times", times.milliseconds.data(), static_cast<int>(FrameTimes::kCount),
                   static_cast<int>(times.next), nullptr, 0, kTop * median,
                   {ImGui::GetContentRegionAvail().x, 36});
  ImGui::TextDisabled("%.1f ms a frame, %.0f frames a second", static_cast<double>(median),
                      1000.0 / static_cast<double>(median));
}

}  // namespace

void show_controls(Session& session, UiState& state) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float margin = 12, unit = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({margin, margin});
  ImGui::SetNextWindowSizeConstraints({21 * unit, 0}, {21 * unit, display.y - 2 * margin});
  ImGui::Begin("##controls", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PushItemWidth(11 * unit);
  ImGui::TextUnformatted(session.stage()->path().filename().c_str());
  show_mode(state);
  if (state.settings.mode == Mode::slice) show_slice_controls(state);
  if (state.settings.mode == Mode::truth || state.settings.mode == Mode::error) show_truth_controls(state);
  ImGui::Spacing();
  show_light_controls(session, state);
  show_look_up_controls(state);
  show_moving_controls(state);
  show_drawing_controls(state);
  show_frame_times(state);
  ImGui::PopItemWidth();
  ImGui::End();
}

}  // namespace pdsm
