// SPDX-License-Identifier: Apache-2.0
// embree_to_hair SEGMENTS POINTS < X.bin > X.hair: the line segments of one of Embree's XML scenes, whose
// binary file begins with them, as a HAIR file. The scene's XML tells both numbers: <indices size="...">,
// <positions size="...">. Neighbouring segments become strands.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Point {
  float x, y, z, radius;
};

template <typename T>
std::vector<T> read_array(std::size_t count) {
  std::vector<T> values(count);
  std::cin.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
  return values;
}

template <typename T>
void write_array(const std::vector<T>& values) {
  std::cout.write(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::streamsize>(values.size() * sizeof(T)));
}

/// Strands by their numbers of segments, and their points one after the other.
struct Hair {
  std::vector<std::uint16_t> lengths;
  std::vector<std::array<float, 3>> places;
  std::vector<float> thickness;

  void add(const Point& p) {
    places.push_back({p.x, p.y, p.z});
    thickness.push_back(2 * p.radius);
  }
};

Hair find_strands(const std::vector<std::int32_t>& segments, const std::vector<Point>& points) {
  Hair hair;
  for (std::size_t n = 0; n < segments.size(); ++n) {
    const auto first = static_cast<std::size_t>(segments[n]);
    const bool follows = n > 0 && segments[n] == segments[n - 1] + 1 &&
                         hair.lengths.back() < std::numeric_limits<std::uint16_t>::max();
    if (!follows) {
      hair.lengths.push_back(0);
      hair.add(points.at(first));
    }
    ++hair.lengths.back();
    hair.add(points.at(first + 1));
  }
  return hair;
}

void write_hair(const Hair& hair) {
  constexpr std::uint32_t kSegments = 1, kPoints = 2, kThickness = 4;
  std::array<char, 128> header{};
  const std::array<std::uint32_t, 3> counts{static_cast<std::uint32_t>(hair.lengths.size()),
                                            static_cast<std::uint32_t>(hair.places.size()),
                                            kSegments | kPoints | kThickness};
  std::memcpy(header.data(), "HAIR", 4);
  std::memcpy(header.data() + 4, counts.data(), sizeof counts);
  std::cout.write(header.data(), header.size());
  write_array(hair.lengths);
  write_array(hair.places);
  write_array(hair.thickness);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: embree_to_hair SEGMENTS POINTS < X.bin > X.hair\n";
    return 2;
  }
  try {
    const auto segments = read_array<std::int32_t>(std::stoul(argv[1]));
    const auto points = read_array<Point>(std::stoul(argv[2]));
    if (!std::cin) throw std::runtime_error("stdin: ends too soon");
    write_hair(find_strands(segments, points));
    std::cout.flush();
    if (!std::cout) throw std::runtime_error("stdout: can't be written");
  } catch (const std::exception& fault) {
    std::cerr << fault.what() << "\n";
    return 3;
  }
  return 0;
}
