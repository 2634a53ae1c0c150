// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/options.h"
#include "cli/streams.h"
#include "evaluate/heat_map.h"
#include "evaluate/map_diff.h"
#include "pdsm/format/map_file.h"

namespace pdsm {
namespace {

struct DiffOptions {
  std::string a, b, image;
  double tolerance = 0;
};

std::string as_text(const MapDifference& d) {
  std::string text =
      fmt::format("max difference   {:.9g}\nmean difference  {:.9g}\ndiffering texels {} of {}\n",
                  d.max_difference, d.mean_difference, d.differing_texels, d.texels);
  if (d.max_difference > 0) {
    text += fmt::format("worst at         image {} level {} texel ({}, {}) depth {:.6g} m\n", d.worst_image,
                        d.worst_level, d.worst_i, d.worst_j, d.worst_depth);
  }
  if (d.differing_domains > 0) text += fmt::format("differing domains {}\n", d.differing_domains);
  return text;
}

/// Texel (0, 0) is at the bottom left, as in all pictures of maps.
RgbImage draw_difference(const MapDifference& d) {
  std::vector<float> from_top;
  from_top.reserve(d.texel_max.size());
  for (std::uint32_t row = 0; row < d.height; ++row) {
    const auto first = d.texel_max.begin() + static_cast<std::ptrdiff_t>(d.height - 1 - row) * d.width;
    from_top.insert(from_top.end(), first, first + d.width);
  }
  const std::string title = fmt::format("max {:.3g}  mean {:.3g}", d.max_difference, d.mean_difference);
  return draw_heat_map(d.width, d.height, from_top, {}, title);
}

int run_diff(const DiffOptions& options) {
  if (!options.image.empty()) {
    if (image_format(options.image, "--output") != ImageFormat::png) {
      refuse_value("--output", "a .png", options.image);
    }
    check_output(options.image, {options.a, options.b});
  }
  const MapDifference difference = compare_maps(read_map(options.a), read_map(options.b));
  if (!difference.incomparable.empty()) {
    write_result("not comparable: " + difference.incomparable + "\n");
    return kExitDoesNotHold;
  }
  write_result(as_text(difference));
  if (!options.image.empty()) write_png(draw_difference(difference), options.image);
  return difference.max_difference <= options.tolerance ? kExitOk : kExitDoesNotHold;
}

}  // namespace

void add_diff_command(CommandLine& line) {
  auto options = std::make_shared<DiffOptions>();
  Options takes =
      line.add_command("diff", "Compare the functions of two maps", [options] { return run_diff(*options); });
  takes.file("A", options->a, "Map");
  takes.file("B", options->b, "Map of the same light and size");
  takes.real("--tolerance", options->tolerance, 0, 1,
             "Exit 1 when the largest difference is above it; default 0");
  takes.text("-o,--output", "IMAGE.png", options->image,
             "Write each texel's largest difference as a picture");
}

}  // namespace pdsm
