// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pdsm {

/// Colours, shapes and font of all panels, `scale` times as large as usual.
void apply_theme(float scale);

}  // namespace pdsm
