// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session.h"
#include "ui/ui_state.h"

/// The parts of the interface; each lays itself out in the current ImGui frame.
namespace pdsm {

/// The panel at the left: mode, lights, look-up, what moves, what is drawn.
void show_controls(Session& session, UiState& state);

/// The lights' part of it: on, brightness, colour; facts of the chosen light's map.
void show_light_controls(Session& session, UiState& state);

/// The attenuation function of state.probe against depth.
void show_function_plot(const Session& session, UiState& state);

/// The colour scale of mode error with its numbers, or that of slices.
void show_colour_scale(const UiState& state);

/// What happened lately, and what to do first.
void show_messages(Session& session);

}  // namespace pdsm
