// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "pdsm/bake/scene.h"
#include "pdsm/format/error.h"

namespace pdsm {

void check_opacity(const Geometry& geometry) {
  if (!(geometry.opacity >= 0 && geometry.opacity <= 1))
    throw Error(Failure::input, geometry.name + ":opacity", "must be from 0 to 1");
  for (int channel = 0; channel < 3; ++channel)
    if (!(geometry.transmission[channel] >= 0 && geometry.transmission[channel] <= 1))
      throw Error(Failure::input, geometry.name + ":transmission", "must be from 0 to 1");
}

void check_mask(const Mesh& mesh, const std::string& name) {
  const auto require = [&](bool holds, const std::string& reason) {
    if (!holds) throw Error(Failure::input, name + ":mask", reason);
  };
  if (!mesh.mask) {
    require(mesh.mask_places.empty(), "places in a mask that is not there");
    return;
  }
  const CutoutMask& mask = *mesh.mask;
  const auto is_size = [](std::uint32_t n) { return n >= 1 && n <= kMostMaskTexels; };
  require(is_size(mask.width) && is_size(mask.height),
          fmt::format("{} x {} texels: must be 1 to {} along each axis", mask.width, mask.height,
                      kMostMaskTexels));
  require(mask.alpha.size() == std::size_t{mask.width} * mask.height,
          fmt::format("{} bytes of alpha for {} x {} texels", mask.alpha.size(), mask.width, mask.height));
  require(mask.transmission.empty() || (mask.blends && mask.transmission.size() == mask.alpha.size()),
          "transmission must have as many texels as alpha, of a mask that blends");
  require(std::isfinite(mask.cutoff) && mask.cutoff >= 0, "the cutoff must be 0 or more");
  for (const MaskWrap wrap : mask.wrap) require(wrap <= MaskWrap::clamp, "the wrap mode is unknown");
  require(mesh.mask_places.size() == mesh.positions.size(),
          fmt::format("{} places for {} positions", mesh.mask_places.size(), mesh.positions.size()));
  require(!mesh.closed, "a mesh with a mask can't be closed");
}

}  // namespace pdsm
