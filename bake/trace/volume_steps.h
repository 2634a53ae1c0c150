// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/layer_map.h"
#include "trace/volume_field.h"

/// Volumes as layers (docs/maths.md, "Volumes"). Along each ray of a map the share of light that volumes have
/// taken grows from 0; wherever it passes one of m steps, the k-th at (k + u) / m, a layer takes 1 / m of the
/// light. u is each light sample's own, so that the mean over samples comes as near to the smooth function as
/// N m steps are fine.
namespace pdsm {

/// The m of a bake of `samples` light samples: so many that independent rays' steps leave a mean within a
/// third of epsilon, rms.
[[nodiscard]] std::uint32_t choose_volume_steps(double epsilon, std::uint32_t samples);
inline constexpr std::uint32_t kLeastVolumeSteps = 4, kMostVolumeSteps = 256;

/// The steps of all light samples of a bake.
class VolumeSteps {
 public:
  VolumeSteps() = default;
  VolumeSteps(std::uint32_t steps, std::uint32_t samples);

  /// u of a sample. Those of all are (n + 1/2) / N, in an order that fits no lattice of samples.
  [[nodiscard]] double offset(std::uint32_t sample) const { return offsets_[sample]; }
  /// Where in its parts a sample's march looks (VolumeField): likewise, in an order that fits no u.
  [[nodiscard]] double march_offset(std::uint32_t sample) const { return march_offsets_[sample]; }
  /// Optical depths of a sample's steps, increasing. Replaces the contents of `depths`.
  void list(std::uint32_t sample, std::vector<double>& depths) const;

 private:
  std::uint32_t steps_ = 0;
  std::vector<double> offsets_, march_offsets_;
};

/// Finds the layers that volumes are to the rays of one thread.
class VolumeLayers {
 public:
  /// `depths`: of the sample's steps; `march_offset`: its own.
  VolumeLayers(std::span<const VolumeField> volumes, std::span<const double> depths, double march_offset)
      : volumes_(volumes), depths_(depths), march_offset_(march_offset) {}

  /// Appends those of a ray between `begin` and `end` in t, in order; their depths begin at `origin_z`.
  void append(const CentralRay& ray, double begin, double end, double origin_z,
              std::vector<MetSurface>& layers);

 private:
  void add_up();

  std::span<const VolumeField> volumes_;
  std::span<const double> depths_;
  double march_offset_;
  std::vector<MarchedPart> parts_, summed_;
  std::vector<std::pair<double, double>>
      changes_;  ///< where, and by how much, optical depth a unit of t changes
};

}  // namespace pdsm
