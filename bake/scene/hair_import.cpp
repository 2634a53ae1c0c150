// SPDX-License-Identifier: Apache-2.0
#include "scene/hair_import.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "scene/format_fault.h"

namespace pdsm {
namespace {

static_assert(std::endian::native == std::endian::little);

/// As the file has it.
struct HairHeader {
  std::array<char, 4> magic{};
  std::uint32_t strands = 0, points = 0, arrays = 0, segments = 0;
  float thickness = 0, transparency = 0;
  std::array<float, 3> colour{};
  std::array<char, 88> text{};
};
static_assert(sizeof(HairHeader) == 128);

/// Bits of HairHeader::arrays, in the order of the file.
enum HairArray : std::uint32_t {
  kSegments = 1,
  kPoints = 2,
  kThickness = 4,
  kTransparency = 8,
  kColour = 16,
  kAllArrays = 31
};

HairHeader read_header(const std::string& bytes) {
  HairHeader header;
  if (bytes.size() < sizeof header) throw FormatFault("is no hair file: it ends within its header");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != std::array{'H', 'A', 'I', 'R'}) throw FormatFault("is no hair file");
  if ((header.arrays & ~kAllArrays) != 0) throw FormatFault("has arrays that are not known");
  if ((header.arrays & kPoints) == 0) throw FormatFault("has no points");
  return header;
}

/// Bytes that the header promises, itself included.
std::uint64_t size_of(const HairHeader& header) {
  const auto has = [&](HairArray array) { return (header.arrays & array) != 0 ? std::uint64_t{1} : 0; };
  const std::uint64_t a_point = 12 + 4 * has(kThickness) + 4 * has(kTransparency) + 12 * has(kColour);
  return sizeof header + 2 * has(kSegments) * header.strands + a_point * header.points;
}

/// Takes arrays off the front of what follows the header.
class ArrayReader {
 public:
  explicit ArrayReader(const std::string& bytes) : at_(bytes.data() + sizeof(HairHeader)) {}

  template <typename T>
  std::vector<T> take(std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), at_, count * sizeof(T));
    at_ += count * sizeof(T);
    return values;
  }

 private:
  const char* at_;
};

/// Segments of each strand; all points are theirs.
std::vector<std::uint32_t> read_lengths(const HairHeader& header, ArrayReader& arrays) {
  std::vector<std::uint32_t> lengths;
  if ((header.arrays & kSegments) != 0)
    for (const std::uint16_t length : arrays.take<std::uint16_t>(header.strands)) lengths.push_back(length);
  else if (header.strands <= header.points)
    lengths.assign(header.strands, header.segments);
  std::uint64_t points = 0;
  for (const std::uint32_t length : lengths) points += std::uint64_t{length} + 1;
  if (lengths.size() != header.strands || points != header.points)
    throw FormatFault("has strands that do not have as many points as there are");
  return lengths;
}

bool is_point(const glm::vec4& p) {
  return std::isfinite(p.x + p.y + p.z) && std::isfinite(p.w) && p.w > 0;
}

/// Points that are none are left out with the segments that end in them.
ImportedHair keep_good(const std::vector<glm::vec4>& points, const std::vector<std::uint32_t>& lengths) {
  ImportedHair hair;
  std::uint32_t first = 0;
  for (const std::uint32_t length : lengths) {
    bool follows = false;
    for (std::uint32_t n = first; n <= first + length; ++n) {
      const bool good = is_point(points[n]);
      if (n > first && good && follows)
        hair.strands.segments.push_back(static_cast<std::uint32_t>(hair.strands.points.size() - 1));
      else if (n > first)
        ++hair.left_out;
      if (good) hair.strands.points.push_back(points[n]);
      follows = good;
    }
    first += length + 1;
  }
  return hair;
}

}  // namespace

ImportedHair import_hair(const std::string& bytes) {
  const HairHeader header = read_header(bytes);
  if (bytes.size() != size_of(header)) throw FormatFault("does not have as many bytes as its header says");
  ArrayReader arrays(bytes);
  const std::vector<std::uint32_t> lengths = read_lengths(header, arrays);
  const auto places = arrays.take<std::array<float, 3>>(header.points);
  const bool has_thickness = (header.arrays & kThickness) != 0;
  const auto thickness = arrays.take<float>(has_thickness ? header.points : 0);
  std::vector<glm::vec4> points;
  points.reserve(places.size());
  for (std::size_t n = 0; n < places.size(); ++n) {
    const auto [x, y, z] = places[n];
    points.emplace_back(x, y, z, 0.5F * (has_thickness ? thickness[n] : header.thickness));
  }
  return keep_good(points, lengths);
}

}  // namespace pdsm
