// SPDX-License-Identifier: Apache-2.0
#include "choose/laws.h"

#include <algorithm>
#include <cmath>

namespace pdsm {
namespace {

/// Points in even distribution on a light: between 1/2 of random and 1 of a line's; seen on all scenes.
constexpr double kSamplingPower = 0.75;
/// Resolution part: 1 on flat scenes with straight edges, 1/2 on rough surfaces that shadow themselves.
constexpr double kTypicalPower = 0.85, kLeastPower = 0.35, kMostPower = 1.3;
/// A resolution part below this share of the whole is too small to tell its power.
constexpr double kTelling = 0.2;
/// Finer maps leave at least this share of the resolution part: their texels are only one cause of it.
constexpr double kLeastLeft = 0.5;
/// Trials this far apart in edge tell the power anew.
constexpr double kFarApart = 1.4;
/// Weight of a power from other points beside the one known: their scatter is in it.
constexpr double kTrust = 0.5;
/// Typical fit part as a share of epsilon.
constexpr double kTypicalFit = 0.17;
/// Typical powers of bytes: a penumbra's texels grow with the edge squared, an outline's with the edge.
constexpr double kTypicalBytesByEdge = 1.85, kTypicalBytesByEpsilon = -1.0, kTypicalBytesBySamples = -0.2;
/// Typical share of a smallest bake's time that does not grow with the work: the BVH and its like.
constexpr double kTypicalFixed = 0.8;
/// A lossless fit counts as one of this epsilon.
constexpr double kLeastEpsilon = 1e-4;
/// Share of a larger trial's time that is taken to grow with the work at least, whatever noise says.
constexpr double kLeastGrowing = 0.2;

double epsilon_ratio(double epsilon, double at) {
  return std::max(epsilon, kLeastEpsilon) / std::max(at, kLeastEpsilon);
}

double power_of(double ratio, double factor) {
  return std::log(ratio) / std::log(factor);
}

/// Bytes of a trial's functions, with the tables that lead to them.
double function_bytes_of(const Trial& trial) {
  return std::max(1.0, static_cast<double>(trial.bytes) - static_cast<double>(trial.sample_bytes));
}

double bytes_per_sample_of(const Trial& trial) {
  return static_cast<double>(trial.sample_bytes) / trial.settings.samples;
}

/// The power p of a part that falls from `at_base` to `left` when the edge grows by `factor`.
double falling_power(double at_base, double left, double factor) {
  if (!(left > 0)) return kMostPower;
  return std::clamp(power_of(at_base / left, factor), kLeastPower, kMostPower);
}

}  // namespace

Laws::Laws(const StarTrials& star) : at_(star.base.settings) {
  // What two fits that err independently, one kStarEpsilon times as much as the other, make of the same
  // functions differs by the hypotenuse of both errors. What sampling and fit leave is the resolution's.
  sampling_ = star.base.sampling_error;
  fit_ = star.fit_change / std::hypot(1.0, kStarEpsilon);
  const double whole = star.base.mean_abs_error(), others = std::hypot(sampling_, fit_);
  resolution_ = std::max(0.0, whole - others);
  resolution_power_ = kTypicalPower;
  if (resolution_ > kTelling * whole) {
    resolution_power_ = falling_power(resolution_, star.finer.mean_abs_error() - others, kStarEdge);
    if (star.finer_maps)
      finer_maps_ = std::clamp((star.finer_maps->mean_abs_error() - others) / resolution_, kLeastLeft, 1.0);
  }

  bytes_ = function_bytes_of(star.base);
  if (star.finer_maps) bytes_of_finer_maps_ = function_bytes_of(*star.finer_maps) / bytes_;
  bytes_by_samples_ = power_of(function_bytes_of(star.more_samples) / bytes_, kStarSamples);
  bytes_by_edge_ = power_of(function_bytes_of(star.finer) / bytes_, kStarEdge);
  bytes_by_epsilon_ = power_of(function_bytes_of(star.looser) / bytes_, kStarEpsilon);
  bytes_per_sample_ = bytes_per_sample_of(star.more_samples);

  const double growth = star.finer.settings.work() / star.base.settings.work();
  fixed_seconds_ = std::max(0.0, (growth * star.base.seconds_bake - star.finer.seconds_bake) / (growth - 1));
  anchor_seconds(star.finer);
}

Laws::Laws(const Trial& only)
    : at_(only.settings),
      sampling_(only.sampling_error),
      fit_(kTypicalFit * only.settings.epsilon),
      resolution_power_(kTypicalPower),
      bytes_per_sample_(bytes_per_sample_of(only)),
      bytes_(function_bytes_of(only)),
      bytes_by_samples_(kTypicalBytesBySamples),
      bytes_by_edge_(kTypicalBytesByEdge),
      bytes_by_epsilon_(kTypicalBytesByEpsilon),
      fixed_seconds_(kTypicalFixed * only.seconds_bake) {
  resolution_ = std::max(0.0, only.mean_abs_error() - std::hypot(sampling_, fit_));
  anchor_seconds(only);
}

double Laws::sampling_error(double samples) const {
  return sampling_ * std::pow(samples / at_.samples, -kSamplingPower);
}

double Laws::resolution_error(double edge, std::uint32_t maps_per_texel) const {
  return resolution_ * std::pow(edge / at_.edge(), -resolution_power_) *
         (maps_per_texel == 2 ? finer_maps_ : 1);
}

double Laws::fit_error(double epsilon) const {
  return fit_ * epsilon_ratio(epsilon, at_.epsilon);
}

double Laws::error(const Settings& s) const {
  return resolution_error(s.edge(), s.maps_per_texel) +
         std::hypot(sampling_error(s.samples), fit_error(s.epsilon));
}

double Laws::bytes(const Settings& s) const {
  return function_bytes(s) + bytes_per_sample_ * s.samples;
}

double Laws::function_bytes(const Settings& s) const {
  return bytes_ * std::pow(static_cast<double>(s.samples) / at_.samples, bytes_by_samples_) *
         std::pow(s.edge() / at_.edge(), bytes_by_edge_) *
         std::pow(epsilon_ratio(s.epsilon, at_.epsilon), bytes_by_epsilon_) *
         (s.maps_per_texel == 2 ? bytes_of_finer_maps_ : 1);
}

double Laws::seconds(const Settings& s) const {
  return fixed_seconds_ + seconds_per_work_ * s.work();
}

void Laws::anchor(const Trial& trial, Points points) {
  anchor_error(trial, points);
  bytes_ *= function_bytes_of(trial) / function_bytes(trial.settings);
  bytes_per_sample_ = bytes_per_sample_of(trial);
  anchor_seconds(trial);
}

void Laws::anchor_error(const Trial& trial, Points points) {
  const Settings& s = trial.settings;
  const double measured = trial.mean_abs_error(), expected = error(s);
  const double resolution = resolution_error(s.edge(), s.maps_per_texel), others = expected - resolution;
  const bool edge_alone = s.samples == at_.samples && s.epsilon == at_.epsilon;
  if (measured <= others || (resolution < others && !edge_alone)) {
    // Nothing tells which part was taken for too much or too little: all are.
    const double scale = expected > 0 ? measured / expected : 1;
    sampling_ *= scale;
    resolution_ *= scale;
    fit_ *= scale;
    return;
  }
  // The part whose setting changed, or the largest, gets what was left unexplained, and its power from where
  // it was seen before.
  const double left = s.maps_per_texel == 2 ? finer_maps_ : 1, seen = (measured - others) / left,
               ratio = s.edge() / at_.edge();
  if (std::max(ratio, 1 / ratio) >= kFarApart) {
    const double power = falling_power(resolution_, seen, ratio), trust = points == Points::same ? 1 : kTrust;
    resolution_power_ += trust * (power - resolution_power_);
  }
  sampling_ = sampling_error(s.samples);
  fit_ = fit_error(s.epsilon);
  resolution_ = seen;
  Settings at = s;
  at.maps_per_texel = at_.maps_per_texel;
  bytes_ = function_bytes(at);
  at_ = at;
}

void Laws::anchor_seconds(const Trial& trial) {
  const double growing = std::max(trial.seconds_bake - fixed_seconds_, kLeastGrowing * trial.seconds_bake);
  seconds_per_work_ = growing / trial.settings.work();
}

}  // namespace pdsm
