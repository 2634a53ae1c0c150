// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pdsm {

/// What a run of the command line left behind.
struct Outcome {
  int exit_code = -1;  ///< 128 + signal when it died of one
  std::string out, err;
};

/// What standard output is.
enum class Stdout { pipe, closed, full, broken_pipe };

struct RunSetup {
  std::string input;             ///< on stdin
  std::filesystem::path folder;  ///< to run in; empty: this one
  Stdout out = Stdout::pipe;
  bool unprivileged = false;  ///< give up root's rights, when we have them
  /// Bytes behind which no file may be written, where not 0: the write that tries kills the process.
  std::uint64_t file_limit = 0;
};

/// Exit code that tells that the binary could not be run at all.
inline constexpr int kNotRun = 126;

/// Runs `pdsm` with arguments as they are: no shell. Kills it after two minutes.
[[nodiscard]] Outcome run_pdsm(const std::vector<std::string>& arguments, const RunSetup& setup = {});

/// A `pdsm` that runs on its own, for signals. stdin stays open and empty.
class RunningPdsm {
 public:
  RunningPdsm(const std::vector<std::string>& arguments, const std::filesystem::path& folder);
  ~RunningPdsm();
  RunningPdsm(const RunningPdsm&) = delete;
  RunningPdsm& operator=(const RunningPdsm&) = delete;

  /// Waits until it handles `signal` itself; false when it ended before.
  [[nodiscard]] bool wait_for_handler(int signal) const;
  /// Waits until it has used this much processor time; false when it ended before.
  [[nodiscard]] bool wait_for_cpu_seconds(double seconds) const;
  /// Waits until a file has at least so many bytes; false when it ended before.
  [[nodiscard]] bool wait_for_file(const std::filesystem::path& file, std::uintmax_t bytes) const;
  void send(int signal) const;
  /// Writes to its stdin.
  void say(const std::string& text) const;
  /// Waits for one line of its stdout.
  [[nodiscard]] std::string hear_line() const;
  /// Its exit code, or 128 + signal.
  [[nodiscard]] int wait();

 private:
  pid_t pid_ = -1;
  int stdin_ = -1, stdout_ = -1;
};

}  // namespace pdsm
