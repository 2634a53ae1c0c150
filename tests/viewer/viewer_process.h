// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pdsm {

/// What a run of the viewer left behind.
struct ViewerOutcome {
  int exit_code = -1;  ///< 128 + signal when it died of one
  std::string out, err;
};

/// A running `pdsm-viewer`, with arguments as they are: no shell. It is killed after two minutes.
class ViewerProcess {
 public:
  /// Runs in `folder`; `display`: leave DISPLAY as it is, else there is none.
  ViewerProcess(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                bool display = true);
  ~ViewerProcess();
  ViewerProcess(const ViewerProcess&) = delete;
  ViewerProcess& operator=(const ViewerProcess&) = delete;

  void send(int signal) const;
  /// Waits for its end.
  [[nodiscard]] ViewerOutcome finish();

 private:
  pid_t pid_ = -1;
  int out_ = -1, err_ = -1;
};

/// Waits until someone who had opened `file` closes it. Made before the file is opened.
class CloseWatch {
 public:
  explicit CloseWatch(const std::filesystem::path& file);
  ~CloseWatch();
  CloseWatch(const CloseWatch&) = delete;
  CloseWatch& operator=(const CloseWatch&) = delete;
  void wait() const;

 private:
  int descriptor_ = -1;
};

}  // namespace pdsm
