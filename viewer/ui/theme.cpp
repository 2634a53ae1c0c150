// SPDX-License-Identifier: Apache-2.0
#include "ui/theme.h"

#include <imgui.h>

#include <filesystem>

namespace pdsm {
namespace {

constexpr float kFontSize = 14;

/// The first font of a short list that the system has; ImGui's own otherwise.
void load_font(float scale) {
  constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
                                    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
                                    "/usr/share/fonts/noto/NotoSans-Regular.ttf",
                                    "/usr/share/fonts/TTF/DejaVuSans.ttf"};
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  std::error_code ignored;
  for (const char* font : kFonts) {
    if (!std::filesystem::is_regular_file(font, ignored)) continue;
    ImFontConfig config;
    config.OversampleH = 2;
    if (atlas.AddFontFromFileTTF(font, kFontSize * scale, &config) != nullptr) return;
  }
  ImFontConfig config;
  config.SizePixels = 13 * scale;
  atlas.AddFontDefault(&config);
}

void set_shapes(ImGuiStyle& style) {
  style.WindowRounding = 8;
  style.ChildRounding = style.FrameRounding = style.PopupRounding = style.GrabRounding = 5;
  style.ScrollbarRounding = 8;
  style.ScrollbarSize = 11;
  style.WindowBorderSize = 1;
  style.FrameBorderSize = 0;
  style.WindowPadding = {14, 12};
  style.FramePadding = {7, 3};
  style.ItemSpacing = {8, 5};
  style.ItemInnerSpacing = {7, 4};
  style.GrabMinSize = 12;
  style.WindowTitleAlign = {0.0F, 0.5F};
}

void set_colours(ImGuiStyle& style) {
  const ImVec4 accent(0.96F, 0.66F, 0.32F, 1), frame(0.19F, 0.205F, 0.235F, 0.95F);
  const ImVec4 hovered(0.26F, 0.28F, 0.32F, 1), active(0.33F, 0.355F, 0.40F, 1);
  ImVec4* colours = style.Colors;
  colours[ImGuiCol_Text] = {0.90F, 0.905F, 0.915F, 1};
  colours[ImGuiCol_TextDisabled] = {0.58F, 0.60F, 0.64F, 1};
  colours[ImGuiCol_WindowBg] = {0.095F, 0.102F, 0.118F, 0.90F};
  colours[ImGuiCol_PopupBg] = {0.11F, 0.118F, 0.135F, 0.98F};
  colours[ImGuiCol_Border] = {1, 1, 1, 0.07F};
  colours[ImGuiCol_FrameBg] = frame;
  colours[ImGuiCol_FrameBgHovered] = hovered;
  colours[ImGuiCol_FrameBgActive] = active;
  colours[ImGuiCol_TitleBg] = colours[ImGuiCol_TitleBgActive] =
      colours[ImGuiCol_TitleBgCollapsed] = {0.12F, 0.13F, 0.15F, 0.97F};
  colours[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
  colours[ImGuiCol_ScrollbarGrab] = hovered;
  colours[ImGuiCol_ScrollbarGrabHovered] = colours[ImGuiCol_ScrollbarGrabActive] = active;
  colours[ImGuiCol_CheckMark] = colours[ImGuiCol_PlotLines] = accent;
  colours[ImGuiCol_SliderGrab] = {0.96F, 0.66F, 0.32F, 0.55F};
  colours[ImGuiCol_SliderGrabActive] = {1.0F, 0.76F, 0.47F, 1};
  colours[ImGuiCol_PlotHistogram] = accent;
  colours[ImGuiCol_Button] = frame;
  colours[ImGuiCol_ButtonHovered] = hovered;
  colours[ImGuiCol_ButtonActive] = active;
  colours[ImGuiCol_Header] = {1, 1, 1, 0.075F};
  colours[ImGuiCol_HeaderHovered] = {1, 1, 1, 0.12F};
  colours[ImGuiCol_HeaderActive] = {1, 1, 1, 0.16F};
  colours[ImGuiCol_Separator] = {1, 1, 1, 0.09F};
  colours[ImGuiCol_ResizeGrip] = {0, 0, 0, 0};
}

}  // namespace

void apply_theme(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  set_shapes(style);
  set_colours(style);
  style.ScaleAllSizes(scale);
  load_font(scale);
}

}  // namespace pdsm
