// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "pdsm/bake/scene.h"

namespace pdsm {

/// A grid of an OpenVDB file.
struct ImportedGrid {
  std::shared_ptr<const DensityGrid> density;  ///< null: a level set
  std::shared_ptr<const Mesh> solid;           ///< of a level set
  glm::dmat4 index_to_file{1.0};               ///< places both
};

/// Reads the grid called `grid` of an OpenVDB file of these bytes, fully: a density or, of the class "level
/// set", a solid. Throws FormatFault: "reason" for what is no such file and for a grid that it lacks, "grid:
/// reason" for one that can't be used.
[[nodiscard]] ImportedGrid import_vdb(std::string bytes, const std::string& grid);

}  // namespace pdsm
