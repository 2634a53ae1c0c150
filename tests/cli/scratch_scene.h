// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "pdsm_process.h"

namespace pdsm {

/// A folder of its own for each test, in which `pdsm` is run. It holds one.scene.json (a plate over a floor,
/// a square light "key") and two.scene.json (the same with a disk light "lamp" too).
class ScratchScene : public ::testing::Test {
 protected:
  ScratchScene();
  ~ScratchScene() override;

  /// Runs pdsm in the folder.
  [[nodiscard]] Outcome run(const std::vector<std::string>& arguments, RunSetup setup = {}) const;

  /// What query or truth, called with `arguments`, answers to one point; fails the test when it fails.
  [[nodiscard]] double value(const std::vector<std::string>& arguments, const std::string& point) const;

  /// Bakes one.scene.json quickly; extra arguments come last. Fails the test when it fails.
  void bake_small(const std::string& output, std::vector<std::string> extra = {}) const;

  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  [[nodiscard]] std::string contents(const std::string& name) const;
  void write_file(const std::string& name, const std::string& text) const;
  /// Names in the folder, sorted.
  [[nodiscard]] std::vector<std::string> listing() const;

 private:
  std::filesystem::path folder_;
};

/// Fails unless the run ended with `code` and, when that means trouble, said why in one line.
void expect_exit(const Outcome& outcome, int code);

}  // namespace pdsm
