// SPDX-License-Identifier: Apache-2.0
#include "support/cutouts.h"

#include "support/random.h"

namespace pdsm::test {

Scene foliage_scene() {
  Scene scene;
  Random random(61);
  for (int n = 0; n < 40; ++n) {
    const double size = n % 2 == 0 ? random.uniform(0.6, 1.5) : random.uniform(0.1, 0.3);
    const double x = random.uniform(-2.5, 1.5), y = random.uniform(-2.5, 1.5);
    // Some show their leaf several times.
    const PlaceRect places{0, 0, n % 3 == 0 ? 3.0 : 1.0, 1};
    add(scene, cut_plate({x, y, x + size, y + size, random.uniform(3, 6)}, leaf_mask(), places));
  }
  add(scene, Plate{-0.5, -0.3, 0.2, 0.4, 3.5});
  add(scene, Plate{-9, -9, 9, 9, 8});
  return scene;
}

}  // namespace pdsm::test
