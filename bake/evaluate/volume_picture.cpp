// SPDX-License-Identifier: Apache-2.0
#include "evaluate/volume_picture.h"

#include <algorithm>

namespace pdsm {
namespace {

/// Pieces of a ray's way through all volumes, in each of which light is asked for once.
constexpr int kPieces = 96;
/// What smoke scatters of the light that it takes.
constexpr glm::vec3 kAlbedo{0.62F, 0.61F, 0.60F};
/// Behind so little, nothing more is seen.
constexpr float kLeastSeen = 1.0F / 512;

}  // namespace

glm::vec3 VolumePicture::over(const glm::dvec3& eye, const glm::dvec3& direction, double distance,
                              const glm::vec3& behind, const Arriving& arriving) const {
  const VolumeShadows::Way way = volumes_.way(eye, direction, 0, distance);
  if (!(way.begin < way.end)) return behind;
  const double length = (way.end - way.begin) / kPieces;
  glm::vec3 seen(0);
  float left = 1;
  for (int n = 0; n < kPieces && left > kLeastSeen; ++n) {
    const double begin = way.begin + n * length;
    const auto kept = static_cast<float>(volumes_.share_left(eye, direction, begin, begin + length));
    if (kept == 1) continue;
    seen += left * (1 - kept) * kAlbedo * arriving(eye + (begin + 0.5 * length) * direction);
    left *= kept;
  }
  return seen + left * behind;
}

}  // namespace pdsm
