// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include "ui/panels.h"

namespace pdsm {
namespace {

void show_light(Session& session, UiState& state, std::size_t index) {
  const Light& light = session.stage()->scene().lights[index];
  LightControl& control = session.lights()[index];
  const float unit = ImGui::GetFontSize();
  ImGui::PushID(static_cast<int>(index));
  ImGui::Checkbox("##on", &control.on);
  ImGui::SameLine();
  ImGui::ColorEdit3("##colour", &control.colour.x, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_Float);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(6.5F * unit);
  ImGui::SliderFloat("##intensity", &control.intensity, 0, 4, "x %.2f");
  ImGui::SameLine();
  // Names are no labels: ImGui would take parts of them for its own.
  if (ImGui::Selectable("##chosen", state.light == index)) state.light = index;
  ImGui::SameLine(0, 0);
  ImGui::TextUnformatted(light.name.c_str());
  ImGui::PopID();
}

void show_facts(const Session& session, std::size_t light) {
  const LoadedMap* map = session.library().of_light(light);
  if (map == nullptr) {
    ImGui::TextDisabled("no map: drop its .pdsm on the window");
    return;
  }
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {4, 0.5F});
  const bool open = ImGui::BeginTable("facts", 2, ImGuiTableFlags_SizingFixedFit);
  ImGui::PopStyleVar();
  if (!open) return;
  for (const Fact& fact : map->facts) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", fact.first.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(fact.second.c_str());
  }
  ImGui::EndTable();
}

}  // namespace

void show_light_controls(Session& session, UiState& state) {
  if (!ImGui::CollapsingHeader("Lights", ImGuiTreeNodeFlags_DefaultOpen)) return;
  for (std::size_t i = 0; i < session.lights().size(); ++i) show_light(session, state, i);
  if (state.light < session.lights().size()) show_facts(session, state.light);
}

}  // namespace pdsm
