// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "choose/star.h"
#include "choose/trial.h"

namespace pdsm {

/// How error, bytes and time follow from the settings, for one light of one scene (docs/maths.md,
/// "Goals"). The error is made of three parts, each with its own law:
///   error = resolution + sqrt(sampling^2 + fit^2)
///   sampling ~ samples^-3/4,  resolution ~ edge^-b,  fit ~ epsilon
/// Maps twice as fine take a share of the resolution part away.
/// Sampling and fit err independently at all points in penumbra; resolution errs much at few points.
/// Bytes of the functions are a product of powers, those of the light samples grow with these; seconds are a
/// fixed part and one in proportion to the work.
class Laws {
 public:
  /// Learns from a star of trials.
  explicit Laws(const StarTrials& star);
  /// Assumes what is typical, where time allows for no more than one trial.
  explicit Laws(const Trial& only);

  /// Holds the laws to another trial: afterwards they give what it gave. The power of the resolution part is
  /// learnt anew, from points that were the same as before or, with less trust, from others.
  enum class Points { same, others };
  void anchor(const Trial& trial, Points points);

  [[nodiscard]] double sampling_error(double samples) const;
  [[nodiscard]] double resolution_error(double edge, std::uint32_t maps_per_texel = 1) const;
  [[nodiscard]] double fit_error(double epsilon) const;
  [[nodiscard]] double error(const Settings& settings) const;
  [[nodiscard]] double bytes(const Settings& settings) const;  ///< of the file without metadata
  /// Of a bake without measuring it. From the clock: never the same twice.
  [[nodiscard]] double seconds(const Settings& settings) const;

 private:
  [[nodiscard]] double function_bytes(const Settings& settings) const;
  void anchor_error(const Trial& trial, Points points);
  void anchor_seconds(const Trial& trial);

  Settings at_;  ///< where the parts below hold, with maps as fine as the map
  double sampling_ = 0, resolution_ = 0, fit_ = 0, resolution_power_ = 0;
  double finer_maps_ = 1, bytes_of_finer_maps_ = 1;  ///< by what maps twice as fine multiply
  double bytes_per_sample_ = 0;
  double bytes_ = 0, bytes_by_samples_ = 0, bytes_by_edge_ = 0, bytes_by_epsilon_ = 0;
  double fixed_seconds_ = 0, seconds_per_work_ = 0;
};

}  // namespace pdsm
