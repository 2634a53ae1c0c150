// SPDX-License-Identifier: Apache-2.0
// Blocks that are handed over as they finish are those of a bake.
#include "pdsm/bake/stream.h"

#include <gtest/gtest.h>

#include <mutex>
#include <stdexcept>

#include "scratch_folder.h"
#include "support/checkpoint_case.h"

namespace pdsm::test {
namespace {

const BakedMap& whole() {
  static const BakedMap baked = bake(checkpoint_scene(), checkpoint_light(), checkpoint_options());
  return baked;
}

/// A bake by its stream, put together again.
BakedMap gather(const BakeOptions& options, Checkpoint* checkpoint = nullptr) {
  std::vector<std::vector<EncodedBlock>> blocks;
  std::mutex mutex;
  BakeStream stream;
  stream.begin = [&](const BakedMap& frame) {
    EXPECT_TRUE(blocks.empty());
    EXPECT_EQ(frame.map.views, whole().map.views);
    EXPECT_EQ(frame.map.coding, whole().map.coding);
    EXPECT_EQ(frame.map.samples, whole().map.samples);
    for (const FunctionImage& image : frame.map.images)
      blocks.emplace_back(std::size_t{image.blocks_across()} * image.blocks_up());
  };
  stream.take = [&](std::uint32_t image, std::uint32_t block, EncodedBlock&& encoded) {
    const std::lock_guard guard(mutex);
    EXPECT_TRUE(blocks.at(image).at(block).bytes.empty()) << "each block once";
    blocks[image][block] = std::move(encoded);
  };
  BakedMap baked = bake_streamed(checkpoint_scene(), checkpoint_light(), options, stream, {}, checkpoint);
  EXPECT_TRUE(baked.blocks.empty());
  baked.blocks = std::move(blocks);
  return baked;
}

TEST(BakeStreamed, GivesTheBlocksOfABake) {
  expect_same_bake(gather(checkpoint_options()), whole());
  BakeOptions options = checkpoint_options();
  options.threads = 3;
  options.tile = 0;
  expect_same_bake(gather(options), whole());
}

TEST(BakeStreamed, IsWholeAfterACheckpoint) {
  const pdsm::testing::ScratchFolder folder;
  bake_until(folder.path() / "c", 4000);
  Checkpoint checkpoint({folder.path() / "c", 0, {}});
  const BakedMap resumed = gather(checkpoint_options(), &checkpoint);
  EXPECT_LT(resumed.report.tiles, 9U);
  expect_same_bake(resumed, whole());
}

TEST(BakeStreamed, WhatTheTakerThrowsEndsTheBake) {
  BakeStream stream;
  stream.take = [](std::uint32_t, std::uint32_t, EncodedBlock&&) { throw std::runtime_error("full"); };
  EXPECT_THROW(
      static_cast<void>(bake_streamed(checkpoint_scene(), checkpoint_light(), checkpoint_options(), stream)),
      std::runtime_error);
}

}  // namespace
}  // namespace pdsm::test
