// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pdsm/bake/bake.h"
#include "pdsm/bake/checkpoint.h"

/// A bake of 3 x 3 blocks, the outer ones cut, with mip levels, that can be stopped and gone on with.
namespace pdsm::test {

[[nodiscard]] Scene checkpoint_scene();
[[nodiscard]] Light checkpoint_light();
/// One block a tile.
[[nodiscard]] BakeOptions checkpoint_options();

struct Resumed {
  BakedMap baked;
  std::vector<std::string> notices;
};

/// Bakes with a checkpoint that is written at once, and leaves the file.
[[nodiscard]] Resumed bake_with(const std::filesystem::path& file, const BakeOptions& options);

/// Bakes until the file has so many bytes, and is then cancelled. Fails the test if it comes to its end.
void bake_until(const std::filesystem::path& file, std::uintmax_t bytes);

/// The same blocks, byte for byte, and the same counts.
void expect_same_bake(const BakedMap& a, const BakedMap& b);

}  // namespace pdsm::test
