// SPDX-License-Identifier: Apache-2.0
// The smallest look-up: how much of the light is blocked at a point?
//   look_up MAP.pdsm X Y Z
#include <cstdlib>
#include <iostream>

#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "pdsm/runtime/look_up.h"

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: look_up MAP.pdsm X Y Z\n";
    return 2;
  }
  try {
    const pdsm::PenumbraMap map = pdsm::read_map(argv[1]);
    const pdsm::PenumbraLookUp look_up(map);
    const std::array<double, 3> point{std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4])};
    std::cout << look_up.at(point, pdsm::Filter::bilinear).attenuation << '\n';
  } catch (const pdsm::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.failure());
  }
}
