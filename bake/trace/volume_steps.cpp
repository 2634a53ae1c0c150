// SPDX-License-Identifier: Apache-2.0
#include "trace/volume_steps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pdsm {
namespace {

/// What steps may add to the error of a mean, rms, as a share of epsilon.
constexpr double kEpsilonShare = 1.0 / 3;
/// The fractions of sqrt(2) and sqrt(3) in 1 / 2^32. Like the golden ratio of the light samples they are of
/// no use to make one another, so that no order runs along another one.
constexpr std::uint32_t kStepOrder = 0x6A09E667, kMarchOrder = 0xBB67AE85;

/// (n + 1/2) / count in the order of the fractions of a sample's number times an odd factor.
std::vector<double> spread(std::uint32_t count, std::uint32_t factor) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [factor](std::uint32_t sample) { return sample * factor; });
  std::vector<double> offsets(count);
  for (std::uint32_t n = 0; n < count; ++n) offsets[order[n]] = (n + 0.5) / count;
  return offsets;
}

}  // namespace

std::uint32_t choose_volume_steps(double epsilon, std::uint32_t samples) {
  const double steps = 1 / (kEpsilonShare * epsilon * std::sqrt(6.0 * samples));
  return static_cast<std::uint32_t>(
      std::clamp(std::ceil(steps), double{kLeastVolumeSteps}, double{kMostVolumeSteps}));
}

VolumeSteps::VolumeSteps(std::uint32_t steps, std::uint32_t samples)
    : steps_(steps), offsets_(spread(samples, kStepOrder)), march_offsets_(spread(samples, kMarchOrder)) {}

void VolumeSteps::list(std::uint32_t sample, std::vector<double>& depths) const {
  depths.clear();
  for (std::uint32_t k = 0; k < steps_; ++k) depths.push_back(-std::log1p(-(k + offset(sample)) / steps_));
}

/// Where volumes overlap, their parts become parts of all together.
void VolumeLayers::add_up() {
  changes_.clear();
  for (const MarchedPart& part : parts_) {
    const double rate = part.optical_depth / (part.end - part.begin);
    changes_.emplace_back(part.begin, rate);
    changes_.emplace_back(part.end, -rate);
  }
  std::ranges::sort(changes_);
  summed_.clear();
  double rate = 0;
  for (std::size_t n = 0; n + 1 < changes_.size(); ++n) {
    rate += changes_[n].second;
    const double begin = changes_[n].first, end = changes_[n + 1].first;
    if (begin < end && rate > 0) summed_.push_back({begin, end, rate * (end - begin)});
  }
}

void VolumeLayers::append(const CentralRay& ray, double begin, double end, double origin_z,
                          std::vector<MetSurface>& layers) {
  parts_.clear();
  std::size_t entered = 0;
  for (const VolumeField& volume : volumes_) {
    const std::size_t before = parts_.size();
    volume.march(ray, begin, end, march_offset_, parts_);
    if (parts_.size() > before) ++entered;
  }
  if (entered > 1) add_up();
  std::size_t next = 0;
  double sum = 0;
  for (const MarchedPart& part : entered > 1 ? summed_ : parts_) {
    const double after = sum + part.optical_depth;
    for (; next < depths_.size() && depths_[next] <= after; ++next) {
      const double t = part.begin + (part.end - part.begin) * (depths_[next] - sum) / part.optical_depth;
      // Of the 1 - next / m that are left, 1 / m.
      layers.push_back({static_cast<float>(origin_z + t), 1 / static_cast<double>(depths_.size() - next)});
    }
    if (next == depths_.size()) return;
    sum = after;
  }
}

}  // namespace pdsm
