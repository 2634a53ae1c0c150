// SPDX-License-Identifier: Apache-2.0
#include "cli/command_line.h"

#include <CLI/CLI.hpp>

#include "cli/streams.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// Throws for a word where a command is wanted, which the parser would call too many arguments.
void check_command(const CLI::App& app, int argc, char** argv) {
  const auto any = [](const CLI::App*) { return true; };
  const auto wanted = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
  if (argc <= 1 || argv[1][0] == '-' || app.get_subcommands(any).empty()) return;
  if (!app.get_subcommands(wanted).empty()) return;
  throw Error(Failure::usage, argv[1], "no such command (--help lists them)");
}

}  // namespace

CommandLine::CommandLine(const std::string& program, const std::string& description,
                         const std::string& version, const std::string& footer)
    : app_(std::make_unique<CLI::App>(description, program)) {
  app_->set_version_flag("--version", version);
  app_->footer(footer);
}

CommandLine::~CommandLine() = default;

Options CommandLine::options() {
  return Options(*app_);
}

Options CommandLine::add_command(const std::string& name, const std::string& help, Run run) {
  app_->require_subcommand(1);
  CLI::App& command = *app_->add_subcommand(name, help);
  command.callback([this, run = std::move(run)] { run_ = run; });
  return Options(command);
}

bool CommandLine::parse(int argc, char** argv) {
  check_command(*app_, argc, argv);
  try {
    app_->parse(argc, argv);
    return true;
  } catch (const CLI::CallForVersion& version) {
    write_result(std::string(version.what()) + "\n");
  } catch (const CLI::Success&) {
    write_result(app_->help());
  } catch (const CLI::Error& error) {
    throw Error(Failure::usage, "", std::string(error.what()) + " (--help tells more)");
  }
  return false;
}

}  // namespace pdsm
