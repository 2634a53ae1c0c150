// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pdsm/bake/bake.h"
#include "tile/bake_job.h"
#include "tile/bake_tile.h"

namespace pdsm {

/// Bakes `job` and gives each finished block to `sink`, once and from several threads, instead of keeping it:
/// for maps that are asked while they are made. Throws Error (resource) when the memory can't be met,
/// (interrupted), and what `sink` throws.
void bake_blocks(const BakeJob& job, const BlockSink& sink, const BakeCallbacks& callbacks = {});

}  // namespace pdsm
