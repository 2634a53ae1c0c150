// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include "ui/panels.h"

namespace pdsm {
namespace {

constexpr ImGuiWindowFlags kStill = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing |
                                    ImGuiWindowFlags_NoInputs;

void show_welcome() {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5F * display.x, 0.5F * display.y}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::Begin("##welcome", nullptr, kStill);
  ImGui::TextUnformatted("Drop a scene file on this window, then the maps that were baked from it.");
  ImGui::TextDisabled("pdsm bake level.scene.json -o level.pdsm");
  ImGui::End();
}

}  // namespace

void show_messages(Session& session) {
  if (!session.stage()) show_welcome();
  const auto& messages = session.messages().recent();
  if (messages.empty()) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x - 12, 12}, ImGuiCond_Always, {1, 0});
  ImGui::Begin("##messages", nullptr, kStill);
  ImGui::PushTextWrapPos(30 * ImGui::GetFontSize());
  for (const Messages::Message& message : messages) {
    const ImVec4 colour =
        message.is_fault ? ImVec4(1.0F, 0.50F, 0.42F, 1) : ImGui::GetStyleColorVec4(ImGuiCol_Text);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(message.text.c_str());
    ImGui::PopStyleColor();
  }
  ImGui::PopTextWrapPos();
  ImGui::End();
}

}  // namespace pdsm
