// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace pdsm {

/// Why something could not be done. The values are the exit codes of the command line.
enum class Failure {
  usage = 2,         ///< the caller's options make no sense
  input = 3,         ///< data from a file or a user is bad
  resource = 4,      ///< output, memory or another resource of the system
  interrupted = 130  ///< the caller asked to stop
};

/// The one exception of pdsm. what() is one line: "where: reason", where `where` is "file:field",
/// "file:line", "stdin:line" or "--option".
class Error : public std::runtime_error {
 public:
  /// Either may quote any bytes, of a file's name or of its text: control characters become spaces.
  Error(Failure failure, const std::string& where, const std::string& reason);

  [[nodiscard]] Failure failure() const noexcept { return failure_; }

 private:
  Failure failure_;
};

}  // namespace pdsm
