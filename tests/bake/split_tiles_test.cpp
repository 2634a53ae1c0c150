// SPDX-License-Identifier: Apache-2.0
// Tiles whose events take more room than there is.
#include <gtest/gtest.h>

#include "pdsm/bake/bake.h"
#include "support/baked_functions.h"
#include "support/checkpoint_case.h"
#include "support/scenes.h"
#include "tile/bake_job.h"

namespace pdsm::test {
namespace {

/// `options` with memory that leaves `bytes` for events.
BakeOptions with_room_for_events(const Scene& scene, const Light& light, BakeOptions options,
                                 std::uint64_t bytes) {
  options.memory = std::uint64_t{1} << 30;
  options.memory -= BakeJob(scene, light, options).plan.event_limit - bytes;
  return options;
}

/// A third of the room that is needed is foreseen to be too little after a 32nd of the samples, so that what
/// is thrown away is about a 32nd of the work on each of three levels of halves. Were tiles filled first, it
/// would be a third of the whole, two thirds of its halves.
TEST(SplitTiles, AreGivenUpBeforeTheyAreFull) {
  const Scene scene = checkpoint_scene();
  BakeOptions options = small_options(192, 192, 256);
  options.threads = 1;
  options.tile = 64;
  const BakedMap blocks = bake(scene, checkpoint_light(), options);
  options.tile = 192;
  const BakedMap whole = bake(scene, checkpoint_light(), options);
  ASSERT_EQ(whole.report.tiles, 1U);
  const BakedMap split =
      bake(scene, checkpoint_light(),
           with_room_for_events(scene, checkpoint_light(), options, whole.report.peak_event_bytes / 3));
  EXPECT_GE(split.report.tiles, 4U);
  expect_same_bake(split, whole);
  // No tiles trace more rays than those of single blocks.
  EXPECT_GT(split.report.rays, whole.report.rays);
  EXPECT_LT(static_cast<double>(split.report.rays), 1.15 * static_cast<double>(blocks.report.rays));
}

}  // namespace
}  // namespace pdsm::test
