// SPDX-License-Identifier: Apache-2.0
#include "support/checkpoint_case.h"

#include <gtest/gtest.h>

#include <system_error>

#include "pdsm/format/error.h"
#include "support/baked_functions.h"
#include "support/scenes.h"

namespace pdsm::test {

Scene checkpoint_scene() {
  Scene scene;
  add(scene, Plate{-1.3, -0.7, 0.4, 0.9, 4});
  add(scene, Plate{0.2, -0.1, 1.4, 1.2, 3});
  add(scene, sphere_mesh({0.3, -0.4, 5}, 0.7, 2));
  add(scene, Plate{-9, -9, 9, 9, 8});
  return scene;
}

Light checkpoint_light() {
  Light light = rect_light(1.5, 1);
  light.window = {-0.5, -0.4, 0.5, 0.4};
  return light;
}

BakeOptions checkpoint_options() {
  BakeOptions options = small_options(150, 129, 8);
  options.mip_levels = 6;
  options.tile = 64;
  return options;
}

Resumed bake_with(const std::filesystem::path& file, const BakeOptions& options) {
  Resumed resumed;
  Checkpoint checkpoint({file, 0, [&](const std::string& line) { resumed.notices.push_back(line); }});
  resumed.baked = bake(checkpoint_scene(), checkpoint_light(), options, {}, &checkpoint);
  return resumed;
}

void bake_until(const std::filesystem::path& file, std::uintmax_t bytes) {
  Checkpoint checkpoint({file, 0, {}});
  BakeCallbacks callbacks;
  callbacks.cancelled = [&] {
    std::error_code missing;
    const std::uintmax_t size = std::filesystem::file_size(file, missing);
    return !missing && size >= bytes;
  };
  try {
    static_cast<void>(
        bake(checkpoint_scene(), checkpoint_light(), checkpoint_options(), callbacks, &checkpoint));
    FAIL() << "came to its end";
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::interrupted) << error.what();
  }
}

void expect_same_bake(const BakedMap& a, const BakedMap& b) {
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t level = 0; level < a.blocks.size(); ++level) {
    ASSERT_EQ(a.blocks[level].size(), b.blocks[level].size());
    for (std::size_t n = 0; n < a.blocks[level].size(); ++n) {
      EXPECT_TRUE(a.blocks[level][n].bytes == b.blocks[level][n].bytes)
          << "level " << level << ", block " << n;
    }
  }
  EXPECT_EQ(a.report.events, b.report.events);
  EXPECT_EQ(a.report.pieces, b.report.pieces);
  EXPECT_EQ(a.report.empty_texels, b.report.empty_texels);
  ASSERT_EQ(a.report.modelled.size(), b.report.modelled.size());
  for (std::size_t n = 0; n < a.report.modelled.size(); ++n) {
    EXPECT_EQ(a.report.modelled[n].reason, b.report.modelled[n].reason);
    EXPECT_EQ(a.report.modelled[n].saved, b.report.modelled[n].saved);
  }
}

}  // namespace pdsm::test
