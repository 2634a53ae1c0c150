// SPDX-License-Identifier: Apache-2.0
#include "light/light_geometry.h"

namespace pdsm {

LightSpace::LightSpace(const Light& light) : position_(light.position) {
  const auto r = light_frame(light).rotation;
  // GLM takes columns.
  rotation_ = glm::dmat3(r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]);
}

}  // namespace pdsm
