// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>

#include "pdsm/format/penumbra_map.h"
#include "trace/light_space.h"
#include "walk/map_grid.h"

/// Where the rays of sample maps pass through holes of cutout casters (docs/maths.md, "Cutouts").
namespace pdsm {

/// What rays that may meet cutouts carry (kCutoutMask): those of one light sample's map, in packets whose
/// lanes are the rays' ids.
struct CutoutRays {
  CutoutRays(const MapGrid& grid, const LightSample& sample);

  /// The lower texel of the packet that is traced next.
  void set_packet(std::int32_t x, std::int32_t y) { lower_texel = {x, y}; }

  RTCIntersectContext context;  // first, so that Embree's pointer to it is one to the whole
  std::uint64_t sample_key = 0;
  std::array<double, 2>
      step{};              ///< change of a ray's direction per texel; of its origin where all are parallel
  double step_across = 0;  ///< of a step along both axes
  bool parallel = false;
  std::array<std::int32_t, 2> lower_texel{};
};

/// Filter of a cutout geometry, whose user data is its LightSpaceMesh: rejects hits in holes by rays of
/// kCutoutMask. To all others the surface is whole. A pure function of light sample, texel and triangle.
void pass_through_holes(const RTCFilterFunctionNArguments* args);

/// Alpha, 0 .. 1, of the mask where a lane's hit sees it: at a random point of the texel's footprint, so that
/// the mean over light samples is that of the mask. A pure function of light sample, texel and triangle.
[[nodiscard]] double alpha_met(const LightSpaceMesh& mesh, const CutoutRays& rays,
                               const RTCFilterFunctionNArguments& args, unsigned lane);

}  // namespace pdsm
