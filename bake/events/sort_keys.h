// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "events/event_log.h"

namespace pdsm {

/// Sorts keys upwards. Many keys are sorted digit by digit, without a branch that can't be foretold; `room`
/// is to work in.
void sort_keys(std::span<EventKey> keys, std::vector<EventKey>& room);

}  // namespace pdsm
