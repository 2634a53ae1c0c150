// SPDX-License-Identifier: Apache-2.0
#include "ui/user_interface.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>

#include "ui/panels.h"
#include "ui/theme.h"

namespace pdsm {
namespace {

void show_panels(Session& session, UiState& state) {
  if (session.stage()) {
    show_controls(session, state);
    show_colour_scale(state);
    if (state.settings.plot || state.settings.mode == Mode::function) show_function_plot(session, state);
  }
  show_messages(session);
}

}  // namespace

UserInterface::UserInterface(GLFWwindow* window, float scale) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  apply_theme(scale);
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

UserInterface::~UserInterface() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void UserInterface::update(Session& session, UiState& state, double seconds) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  // The application's own time, which is fixed for screenshots.
  ImGui::GetIO().DeltaTime = static_cast<float>(std::max(seconds, 1e-4));
  ImGui::NewFrame();
  // Hidden panels are not there at all: they would take the mouse.
  if (state.visible) show_panels(session, state);
  ImGui::Render();
}

void UserInterface::draw() const {
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool UserInterface::wants_mouse() const {
  return ImGui::GetIO().WantCaptureMouse;
}

bool UserInterface::wants_keyboard() const {
  return ImGui::GetIO().WantTextInput;
}

}  // namespace pdsm
