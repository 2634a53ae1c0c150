// SPDX-License-Identifier: Apache-2.0
// Map files: the reader, the checker, and look-ups in what they let through.
#include <array>
#include <cstring>
#include <span>
#include <vector>

#include "file_bytes.h"
#include "fuzz_target.h"
#include "pdsm/format/map_file.h"
#include "pdsm/runtime/look_up.h"

namespace pdsm::testing {
namespace {

// What a small file may decode to here; large ones would only make the fuzzer slow.
constexpr ReadLimits kLimits{std::uint64_t{32} << 20};

/// Points that are in the first view's window, around it, behind the light and nowhere.
std::vector<std::array<double, 3>> view_points(const View& view) {
  std::vector<std::array<double, 3>> points{{0, 0, 0}, {1e300, -1e300, 1e300}, {0, 0, -1}};
  for (const double share : {0.0, 0.3, 1.0}) {
    const double z = view.near_depth + share * (view.far_depth - view.near_depth);
    const double scale = view.projection == Projection::perspective ? z : 1;
    for (const double at : {-0.1, 0.0, 0.45, 1.0}) {
      const double x = view.window[0] + at * (view.window[2] - view.window[0]);
      const double y = view.window[1] + (1 - at) * (view.window[3] - view.window[1]);
      points.push_back({x * scale, y * scale, z});
    }
  }
  return points;
}

void demand_attenuation(float value) {
  demand(value >= 0 && value <= 1, "an attenuation from 0 to 1");
}

void look_up(const PenumbraMap& map) {
  const PenumbraLookUp look_up(map);
  const auto points = view_points(map.views[0]);
  std::vector<float> many(points.size());
  for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
    for (const auto& point : points) demand_attenuation(look_up.at_view_point(point, filter).attenuation);
    look_up.attenuations(points, filter, many);
    for (std::size_t n = 0; n < points.size(); ++n) {
      const float one = look_up.at(points[n], filter).attenuation;
      demand_attenuation(one);
      demand(many[n] == one, "batches that answer as single look-ups do");
      demand_attenuation(look_up.at(points[n], filter, 0.5).attenuation);
    }
  }
}

/// The reader and the checker agree, and what is read holds all invariants and can be written again.
void read(const Bytes& bytes) {
  const bool is_good = check_map(bytes, kLimits).empty();
  static_cast<void>(list_chunks(bytes));
  PenumbraMap map;
  const bool was_read = refused_or_read([&] { map = read_map(bytes, "bytes", kLimits); });
  demand(was_read == is_good, "a checker that agrees with the reader");
  if (!was_read) return;
  demand(find_invariant_fault(map).empty(), "a map that holds its invariants");
  demand(read_map(serialize_map(map, {Compression::none}), "again") == map, "a map that survives writing");
  look_up(map);
}

}  // namespace
}  // namespace pdsm::testing

/// Reads the bytes as they are, and once more with size and checksums made right: hardly anything that a
/// fuzzer tries would come past those otherwise.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pdsm::testing;
  Bytes bytes(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  read(bytes);
  if (size < kHeaderSize) return 0;
  put<std::uint64_t>(bytes, kFileSizeAt, size);
  repair_checksums(bytes);
  read(bytes);
  return 0;
}
