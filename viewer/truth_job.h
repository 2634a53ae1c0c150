// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "stage.h"
#include "truth/shadow_rays.h"

namespace pdsm {

/// A light that the truth is asked of.
struct TruthLight {
  std::size_t light = 0;  ///< index in the scene
  double near_depth = 0;  ///< metres; see ShadowRays

  friend auto operator<=>(const TruthLight&, const TruthLight&) = default;
};

/// The points of a picture, row by row.
struct TruthTask {
  int width = 0, height = 0;
  std::vector<glm::vec4> positions;  ///< metres from the origin; w = 0: no surface
  std::vector<TruthLight> lights;
  std::vector<std::vector<std::uint8_t>> shines;  ///< of each light: whether it shines on a pixel's surface
  std::uint32_t samples = 1;                      ///< shadow rays a point and light
};

/// Pixels of a coarse grid come first, then those of finer ones; steps of the grids in pixels.
inline constexpr int kTruthStrides[] = {8, 4, 2, 1};

/// How far a task is.
struct TruthProgress {
  double done = 0;  ///< 0..1
  bool finished = true;
  std::string fault;  ///< why it can't be finished; else empty
};

/// Works on one task at a time, in the background. All calls are for one thread.
class TruthJob {
 public:
  explicit TruthJob(std::shared_ptr<const Stage> stage);
  ~TruthJob();
  TruthJob(const TruthJob&) = delete;
  TruthJob& operator=(const TruthJob&) = delete;

  /// Begins a task in place of the one before it.
  void start(TruthTask task);
  void cancel();
  /// Blocks until the task is finished, or can't be.
  void wait();

  [[nodiscard]] TruthProgress progress() const;
  /// Attenuation of each light and pixel; -1 where it is not known yet, or there is no surface. 0 where the
  /// light does not shine on the surface.
  [[nodiscard]] std::vector<std::vector<float>> values() const;

 private:
  using Generation = std::uint64_t;

  void run(const std::stop_token& stop);
  void work(const TruthTask& task, Generation generation);
  void work_row(const TruthTask& task, const std::vector<const ShadowRays*>& rays, int y, int stride,
                Generation generation);
  [[nodiscard]] const ShadowRays& rays_of(const TruthLight& light);

  std::shared_ptr<const Stage> stage_;
  std::map<TruthLight, std::unique_ptr<ShadowRays>> rays_;  // of the worker alone

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::shared_ptr<const TruthTask> task_;  // waiting to be begun
  std::vector<std::vector<float>> values_;
  std::size_t pixels_done_ = 0, pixels_ = 0;
  TruthProgress progress_;
  std::atomic<Generation> generation_{0};

  std::jthread worker_;  // last: ends before what it uses
};

}  // namespace pdsm
