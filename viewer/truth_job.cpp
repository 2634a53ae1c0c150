// SPDX-License-Identifier: Apache-2.0
#include "truth_job.h"

#include <exception>
#include <utility>

namespace pdsm {
namespace {

/// Whether a grid before that of `stride` has the pixel.
bool is_on_coarser_grid(int x, int y, int stride) {
  return stride != kTruthStrides[0] && x % (2 * stride) == 0 && y % (2 * stride) == 0;
}

}  // namespace

TruthJob::TruthJob(std::shared_ptr<const Stage> stage)
    : stage_(std::move(stage)), worker_([this](const std::stop_token& stop) { run(stop); }) {}

TruthJob::~TruthJob() {
  ++generation_;
  worker_.request_stop();
}

void TruthJob::start(TruthTask task) {
  auto shared = std::make_shared<const TruthTask>(std::move(task));
  const std::scoped_lock lock(mutex_);
  ++generation_;
  pixels_ = static_cast<std::size_t>(shared->width) * static_cast<std::size_t>(shared->height);
  pixels_done_ = 0;
  values_.assign(shared->lights.size(), std::vector<float>(pixels_, -1.0F));
  progress_ = {0, false, {}};
  task_ = std::move(shared);
  changed_.notify_all();
}

void TruthJob::cancel() {
  const std::scoped_lock lock(mutex_);
  ++generation_;
  task_.reset();
  progress_ = {0, true, {}};
}

void TruthJob::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return progress_.finished; });
}

TruthProgress TruthJob::progress() const {
  const std::scoped_lock lock(mutex_);
  return progress_;
}

std::vector<std::vector<float>> TruthJob::values() const {
  const std::scoped_lock lock(mutex_);
  return values_;
}

void TruthJob::run(const std::stop_token& stop) {
  while (true) {
    std::shared_ptr<const TruthTask> task;
    Generation generation = 0;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [this] { return task_ != nullptr; })) return;
      task = std::exchange(task_, nullptr);
      generation = generation_;
    }
    std::string fault;
    try {
      work(*task, generation);
    } catch (const std::exception& error) {
      fault = error.what();
    }
    const std::scoped_lock lock(mutex_);
    if (generation != generation_) continue;
    progress_ = {fault.empty() ? 1.0 : progress_.done, true, fault};
    changed_.notify_all();
  }
}

void TruthJob::work(const TruthTask& task, Generation generation) {
  std::vector<const ShadowRays*> rays;
  for (const TruthLight& light : task.lights) {
    if (generation != generation_) return;
    rays.push_back(&rays_of(light));
  }
  for (const int stride : kTruthStrides) {
    const int rows = (task.height + stride - 1) / stride;
#pragma omp parallel for schedule(dynamic, 1)
    for (int row = 0; row < rows; ++row) work_row(task, rays, row * stride, stride, generation);
  }
}

void TruthJob::work_row(const TruthTask& task, const std::vector<const ShadowRays*>& rays, int y, int stride,
                        Generation generation) {
  std::vector<std::pair<std::size_t, float>> found;
  std::size_t passed = 0;
  for (std::size_t light = 0; light < rays.size(); ++light) {
    found.clear();
    passed = 0;
    for (int x = 0; x < task.width; x += stride) {
      if (is_on_coarser_grid(x, y, stride)) continue;
      if (generation != generation_) return;
      ++passed;
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(task.width) + static_cast<std::size_t>(x);
      const glm::vec4& position = task.positions[pixel];
      if (position.w == 0.0F) continue;
      // One seed for all points: what error there is varies as smoothly as the scene, and is no noise.
      const glm::dvec3 point = glm::dvec3(glm::vec3(position)) + stage_->origin();
      const bool shines = task.shines[light][pixel] != 0;
      found.emplace_back(
          pixel, shines ? static_cast<float>(rays[light]->attenuation(point, task.samples, 0)) : 0.0F);
    }
    const std::scoped_lock lock(mutex_);
    if (generation != generation_) return;
    for (const auto& [pixel, value] : found) values_[light][pixel] = value;
  }
  const std::scoped_lock lock(mutex_);
  if (generation != generation_) return;
  pixels_done_ += passed;
  progress_.done = static_cast<double>(pixels_done_) / static_cast<double>(pixels_);
}

const ShadowRays& TruthJob::rays_of(const TruthLight& light) {
  std::unique_ptr<ShadowRays>& rays = rays_[light];
  if (!rays) {
    rays =
        std::make_unique<ShadowRays>(stage_->scene(), stage_->scene().lights[light.light], light.near_depth);
  }
  return *rays;
}

}  // namespace pdsm
