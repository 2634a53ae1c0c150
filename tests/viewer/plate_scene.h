// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/camera.h"
#include "evaluate/image_io.h"
#include "pdsm/bake/scene.h"
#include "viewer_process.h"

namespace pdsm {

/// A folder with plate.scene.json (a plate of 2 x 2 m at y = 1 over a floor, a light "key" of 1 x 1 m at y =
/// 4) and its map key.pdsm; empty.pdsm, a map of the same light without any shadow; two.scene.json with a
/// light "lamp" too, and its map lamp.pdsm; lamp.scene.json with that light alone. Baked once for all tests.
class PlateScene : public ::testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();

  /// Empties what a test before left.
  void SetUp() override;

  /// Runs the viewer in the folder.
  [[nodiscard]] static ViewerOutcome run(const std::vector<std::string>& arguments, bool display = true);
  /// Runs it for a screenshot of kWidth x kHeight from camera(), of plate.scene.json and key.pdsm without
  /// what moves and without panels unless `arguments` say so; fails the test when that does not succeed.
  [[nodiscard]] static RgbImage picture(std::vector<std::string> arguments, ViewerOutcome* outcome = nullptr);

  [[nodiscard]] static std::filesystem::path path(const std::string& name) { return folder() / name; }
  [[nodiscard]] static const std::filesystem::path& folder();
  static void copy(const std::string& from, const std::string& to);
  static void write(const std::string& name, const std::string& text);

  /// Looks at the floor past the plate.
  [[nodiscard]] static Camera camera() { return {{1.5, 3.2, 6}, {0.4, 0.2, 0}, 45}; }
  static constexpr std::uint32_t kWidth = 320, kHeight = 240;

  /// Where the ray through a pixel's middle meets the floor; nothing when the plate or nothing is there.
  [[nodiscard]] static std::optional<glm::dvec3> floor_at(double x, double y);
  /// The fraction of the light that the plate hides from a point of the floor, in closed form.
  [[nodiscard]] static double hidden_from(const glm::dvec3& floor_point);
};

/// Fails unless the run ended with `code` and said why in one line.
void expect_fault(const ViewerOutcome& outcome, int code);

}  // namespace pdsm
