// SPDX-License-Identifier: Apache-2.0
#include "truth_overlay.h"

#include <algorithm>
#include <cmath>

#include "evaluate/heat_map.h"
#include "pdsm/format/error.h"
#include "programs.h"
#include "truth_error.h"

namespace pdsm {
namespace {

constexpr int kFramesStill = 2;
/// Time between uploads while the truth grows: often enough to be watched, seldom enough to cost little.
constexpr std::chrono::milliseconds kRefreshTime{200};

void use_nearest(GLenum target) {
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

std::vector<std::vector<std::uint8_t>> shining(const CapturedSurfaces& captured) {
  std::vector<std::vector<std::uint8_t>> shines;
  for (const std::vector<glm::vec2>& look_ups : captured.look_ups) {
    std::vector<std::uint8_t>& flags = shines.emplace_back(look_ups.size());
    std::transform(look_ups.begin(), look_ups.end(), flags.begin(),
                   [](const glm::vec2& look_up) { return look_up.y > 0 ? 1 : 0; });
  }
  return shines;
}

}  // namespace

void TruthOverlay::update(const std::shared_ptr<const Stage>& stage, const TruthKey& key,
                          const LookUpKey& look_ups, bool at_once,
                          const std::function<CapturedSurfaces()>& capture) {
  frames_still_ = key == last_key_ ? frames_still_ + 1 : 0;
  last_key_ = key;
  if (started_ && key == key_) {
    if (!(look_ups == look_ups_)) {
      captured_ = capture();
      look_ups_ = look_ups;
      refresh();
    }
    refresh_if_due();
    return;
  }
  if (job_ && started_) job_->cancel();
  if (ready_) ++version_;
  started_ = ready_ = false;
  if (!at_once && frames_still_ < kFramesStill) return;
  look_ups_ = look_ups;
  start(stage, key, capture());
}

void TruthOverlay::start(const std::shared_ptr<const Stage>& stage, const TruthKey& key,
                         CapturedSurfaces captured) {
  if (!job_ || job_stage_ != stage.get()) {
    job_ = std::make_unique<TruthJob>(stage);
    job_stage_ = stage.get();
  }
  captured_ = std::move(captured);
  key_ = key;
  started_ = true;
  shown_done_ = 0;
  numbers_ = {};
  job_->start({key.width, key.height, captured_.positions, key.lights, shining(captured_), key.samples});
}

void TruthOverlay::finish() {
  if (!job_) return;
  job_->wait();
  const std::string fault = job_->progress().fault;
  if (!fault.empty()) throw Error(Failure::resource, "truth", fault);
  refresh();
}

void TruthOverlay::refresh_if_due() {
  const TruthProgress progress = job_->progress();
  const auto now = std::chrono::steady_clock::now();
  if (progress.done == shown_done_ || (!progress.finished && now - refreshed_ < kRefreshTime)) return;
  refreshed_ = now;
  refresh();
}

void TruthOverlay::refresh() {
  shown_done_ = job_->progress().done;
  ++version_;
  // The coarsest grid alone tells of the whole picture.
  constexpr double kCoarsestShare = 1.0 / (kTruthStrides[0] * kTruthStrides[0]);
  const std::vector<std::vector<float>> truth = job_->values();
  upload_truth(truth);
  upload_error(truth);
  ready_ = shown_done_ >= kCoarsestShare;
}

void TruthOverlay::upload_truth(const std::vector<std::vector<float>>& truth) {
  truth_ = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D_ARRAY, truth_.name());
  use_nearest(GL_TEXTURE_2D_ARRAY);
  const auto layers = static_cast<GLsizei>(std::max<std::size_t>(1, truth.size()));
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_R16, key_.width, key_.height, layers, 0, GL_RED, GL_FLOAT, nullptr);
  for (std::size_t light = 0; light < truth.size(); ++light) {
    const std::vector<float> shown = fill_from_coarser(truth[light], truth[light], key_.width, key_.height);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(light), key_.width, key_.height, 1,
                    GL_RED, GL_FLOAT, shown.data());
  }
}

void TruthOverlay::upload_error(const std::vector<std::vector<float>>& truth) {
  const std::vector<float> difference = truth_error(captured_, truth);
  numbers_ = summarise_difference(difference);
  std::vector<float> magnitude(difference.size());
  std::transform(difference.begin(), difference.end(), magnitude.begin(),
                 [](float d) { return std::isnan(d) ? -1.0F : std::abs(d); });
  error_top_ = static_cast<float>(heat_map_top(magnitude));
  const std::vector<float> shown =
      truth.empty() ? magnitude : fill_from_coarser(magnitude, truth.front(), key_.width, key_.height);
  error_ = GlTexture::make();
  glBindTexture(GL_TEXTURE_2D, error_.name());
  use_nearest(GL_TEXTURE_2D);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, key_.width, key_.height, 0, GL_RED, GL_FLOAT, shown.data());
}

void TruthOverlay::bind() const {
  glActiveTexture(GL_TEXTURE0 + kTruthUnit);
  glBindTexture(GL_TEXTURE_2D_ARRAY, truth_.name());
  glActiveTexture(GL_TEXTURE0 + kErrorUnit);
  glBindTexture(GL_TEXTURE_2D, error_.name());
}

}  // namespace pdsm
