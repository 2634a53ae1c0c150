// SPDX-License-Identifier: Apache-2.0
#include "cli/streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

void fill_if_closed(int descriptor, int flags) {
  if (fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) return;
  // The lowest free number is this one: those below are open by now.
  [[maybe_unused]] const int opened = open("/dev/null", flags | O_CLOEXEC);
}

[[noreturn]] void throw_stdout_error() {
  throw Error(Failure::resource, "stdout", std::strerror(errno));
}

}  // namespace

void prepare_streams() {
  fill_if_closed(STDIN_FILENO, O_RDONLY);
  fill_if_closed(STDOUT_FILENO, O_RDONLY);  // reads only, so that a write fails as on a closed stream
  fill_if_closed(STDERR_FILENO, O_WRONLY);
  std::signal(SIGPIPE, SIG_IGN);
}

void write_result(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) throw_stdout_error();
}

void flush_results() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw_stdout_error();
}

void write_warning(std::string_view text) {
  write_error_line("warning: " + std::string(text));
}

void write_error_line(std::string_view text) {
  std::string line(text);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace pdsm
