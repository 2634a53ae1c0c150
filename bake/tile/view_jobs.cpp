// SPDX-License-Identifier: Apache-2.0
#include "tile/view_jobs.h"

namespace pdsm {

BakeCallbacks view_callbacks(const BakeCallbacks& callbacks, std::size_t job, std::size_t count) {
  if (count == 1 || !callbacks.progress) return callbacks;
  BakeCallbacks of_job = callbacks;
  of_job.progress = [tell = callbacks.progress, job, count](const BakeProgress& progress) {
    BakeProgress of_all = progress;
    of_all.done = (static_cast<double>(job) + progress.done) / static_cast<double>(count);
    tell(of_all);
  };
  return of_job;
}

}  // namespace pdsm
