// SPDX-License-Identifier: Apache-2.0
// The smallest look-up: how much of the light is blocked at a point?
//   look_up MAP.pdsm X Y Z
#include <charconv>
#include <iostream>
#include <string>

#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "pdsm/runtime/look_up.h"

double parse(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, value);
  if (fault != std::errc() || stop != end) throw pdsm::Error(pdsm::Failure::usage, text, "is not a number");
  return value;
}

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: look_up MAP.pdsm X Y Z\n";
    return 2;
  }
  try {
    const pdsm::PenumbraMap map = pdsm::read_map(argv[1]);
    const pdsm::PenumbraLookUp look_up(map);
    const std::array<double, 3> point{parse(argv[2]), parse(argv[3]), parse(argv[4])};
    std::cout << look_up.at(point, pdsm::Filter::bilinear).attenuation << '\n';
  } catch (const pdsm::Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.failure());
  }
}
