// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "evaluate/render.h"
#include "gl_objects.h"
#include "surface_capture.h"
#include "truth_job.h"

namespace pdsm {

/// What the truth of a picture depends on.
struct TruthKey {
  std::uint64_t stage_version = 0;
  int width = 0, height = 0;
  glm::dmat4 world_to_clip{1};
  glm::mat4 object{1};
  bool has_object = false;
  std::vector<TruthLight> lights;
  std::uint32_t samples = 1;

  friend bool operator==(const TruthKey&, const TruthKey&) = default;
};

/// What the look-ups depend on besides.
struct LookUpKey {
  std::uint64_t map_version = 0;
  int filter = 0, layout = 0;
  float normal_offset = 0;
  bool use_footprint = false;

  friend bool operator==(const LookUpKey&, const LookUpKey&) = default;
};

/// The truth of the picture that is being shown, as textures that get finer while the worker works. It begins
/// anew when the picture has changed and then stood still for some frames.
class TruthOverlay {
 public:
  /// Call once a frame in which the truth is wanted. `capture` reads the surfaces of the picture; `at_once`:
  /// do not wait for the picture to stand still.
  void update(const std::shared_ptr<const Stage>& stage, const TruthKey& key, const LookUpKey& look_ups,
              bool at_once, const std::function<CapturedSurfaces()>& capture);

  /// Blocks until all of it is there. Throws Error (resource) when that can't be.
  void finish();

  /// Whether the textures hold anything of the picture yet.
  [[nodiscard]] bool is_ready() const { return ready_; }
  [[nodiscard]] TruthProgress progress() const { return job_ ? job_->progress() : TruthProgress{}; }
  [[nodiscard]] const DifferenceSummary& numbers() const { return numbers_; }
  /// The error that is the end of the colour scale.
  [[nodiscard]] float error_top() const { return error_top_; }

  /// Rises whenever the textures are others.
  [[nodiscard]] std::uint64_t version() const { return version_; }

  /// Binds truth and error to their units.
  void bind() const;

 private:
  void start(const std::shared_ptr<const Stage>& stage, const TruthKey& key, CapturedSurfaces captured);
  void refresh_if_due();
  void refresh();
  void upload_truth(const std::vector<std::vector<float>>& truth);
  void upload_error(const std::vector<std::vector<float>>& truth);

  std::unique_ptr<TruthJob> job_;
  const Stage* job_stage_ = nullptr;
  TruthKey key_, last_key_;
  LookUpKey look_ups_;
  int frames_still_ = 0;
  bool started_ = false, ready_ = false;
  double shown_done_ = 0;
  std::uint64_t version_ = 0;
  std::chrono::steady_clock::time_point refreshed_;

  CapturedSurfaces captured_;
  GlTexture truth_, error_;
  DifferenceSummary numbers_;
  float error_top_ = 0.01F;
};

}  // namespace pdsm
