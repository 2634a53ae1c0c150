// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>
#include <memory>

#include "cli/command.h"
#include "cli/options.h"
#include "cli/point_lines.h"
#include "pdsm/format/map_file.h"
#include "pdsm/runtime/look_up.h"

namespace pdsm {
namespace {

struct QueryOptions {
  std::string map;
  Filter filter = Filter::bilinear;
  bool status = false;
};

const char* status_name(PointStatus status) {
  switch (status) {
    case PointStatus::inside:
      return "inside";
    case PointStatus::outside:
      return "outside";
    case PointStatus::behind:
      return "behind";
    case PointStatus::past_end:
      return "past-end";
  }
  return "";
}

int run_query(const QueryOptions& options) {
  const PenumbraMap map = read_map(options.map);
  const PenumbraLookUp look_up(map);
  answer_point_lines([&](std::span<const glm::dvec3> points, std::string& lines) {
    for (const glm::dvec3& p : points) {
      const LookUpResult found = look_up.at({p.x, p.y, p.z}, options.filter);
      const auto& [red, green, blue] = found.rgb;
      if (map.channels == 1)
        fmt::format_to(std::back_inserter(lines), "{:.9g}", found.attenuation);
      else
        fmt::format_to(std::back_inserter(lines), "{:.9g} {:.9g} {:.9g}", red, green, blue);
      if (options.status) lines.append(" ").append(status_name(found.status));
      lines += '\n';
    }
  });
  return kExitOk;
}

}  // namespace

void add_query_command(CommandLine& line) {
  auto options = std::make_shared<QueryOptions>();
  Options takes = line.add_command("query",
                                   "Attenuation at points: world points \"x y z\" on stdin, one number a "
                                   "line on stdout; three, red, green and blue, of a map of "
                                   "three channels",
                                   [options] { return run_query(*options); });
  takes.file("FILE", options->map, "Map");
  takes.choice("--filter", options->filter, {{"nearest", Filter::nearest}, {"bilinear", Filter::bilinear}},
               "Default: bilinear");
  takes.flag("--status", options->status, "Append inside, outside, behind or past-end");
}

}  // namespace pdsm
