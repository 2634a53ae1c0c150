// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tradeoff/measurement.h"
#include "tradeoff/sweep.h"

namespace pdsm {

/// A folder of its own, gone with it.
class SweepFolder : public ::testing::Test {
 protected:
  SweepFolder();
  ~SweepFolder() override;
  [[nodiscard]] std::filesystem::path path(const std::string& name = "") const { return folder_ / name; }
  [[nodiscard]] std::string contents(const std::string& name) const;
  void write_file(const std::string& name, const std::string& text) const;

  /// A quick sweep of 16 samples and 32 x 32 texels into the folder.
  [[nodiscard]] SweepOptions small_options() const;

 private:
  std::filesystem::path folder_;
};

/// A square light over a plate and a floor, which slopes, so that ends of domain differ.
[[nodiscard]] Scene small_scene();

/// Callbacks that stop a sweep at nothing and write no metadata.
[[nodiscard]] SweepCallbacks plain_callbacks();

/// A measurement in which every field has a value of its own.
[[nodiscard]] Measurement example_measurement(std::uint32_t samples);

}  // namespace pdsm
