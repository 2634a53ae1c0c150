// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "cli/options.h"

namespace pdsm {

/// Does the work of a command. Returns an exit code or throws Error.
using Run = std::function<int()>;

/// A program's command line: options of its own, or commands with theirs.
class CommandLine {
 public:
  /// `version` is what --version prints, `footer` what --help ends with.
  CommandLine(const std::string& program, const std::string& description, const std::string& version,
              const std::string& footer);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// What the program itself may be given.
  [[nodiscard]] Options options();

  /// A command of the program, one of which must be given; `run` does it.
  Options add_command(const std::string& name, const std::string& help, Run run);

  /// Reads the arguments into the options' targets. False: help or version was asked for, and is on stdout.
  /// Throws Error (usage).
  [[nodiscard]] bool parse(int argc, char** argv);

  /// What the command that was given does.
  [[nodiscard]] const Run& run() const { return run_; }

 private:
  std::unique_ptr<CLI::App> app_;
  Run run_;
};

}  // namespace pdsm
