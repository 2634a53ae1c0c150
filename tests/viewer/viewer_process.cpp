// SPDX-License-Identifier: Apache-2.0
#include "viewer_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace pdsm {
namespace {

constexpr unsigned kTimeLimit = 120;  // seconds
constexpr int kNotRun = 126;

std::array<int, 2> make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe");
  return ends;
}

[[noreturn]] void become_viewer(const std::vector<std::string>& arguments,
                                const std::filesystem::path& folder, bool display, int out, int err) {
  alarm(kTimeLimit);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  if (!display) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
  }
  static char binary[] = PDSM_VIEWER_BINARY;
  std::vector<char*> argv{binary};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  if (chdir(folder.c_str()) == 0) execv(argv.front(), argv.data());
  _exit(kNotRun);
}

}  // namespace

ViewerProcess::ViewerProcess(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                             bool display) {
  const std::array<int, 2> out = make_pipe(), err = make_pipe();
  pid_ = fork();
  if (pid_ == 0) become_viewer(arguments, folder, display, out[1], err[1]);
  close(out[1]);
  close(err[1]);
  out_ = out[0];
  err_ = err[0];
}

ViewerProcess::~ViewerProcess() {
  close(out_);
  close(err_);
  if (pid_ < 0) return;
  send(SIGKILL);
  waitpid(pid_, nullptr, 0);
}

void ViewerProcess::send(int signal) const {
  kill(pid_, signal);
}

ViewerOutcome ViewerProcess::finish() {
  ViewerOutcome outcome;
  std::array<pollfd, 2> polled{{{out_, POLLIN, 0}, {err_, POLLIN, 0}}};
  const auto gather = [](pollfd& from, std::string& to) {
    std::array<char, 4096> buffer{};
    const ssize_t got = read(from.fd, buffer.data(), buffer.size());
    if (got > 0) to.append(buffer.data(), static_cast<std::size_t>(got));
    if (got <= 0) from.fd = -1;
  };
  while (polled[0].fd >= 0 || polled[1].fd >= 0) {
    poll(polled.data(), polled.size(), -1);
    if (polled[0].fd >= 0 && polled[0].revents != 0) gather(polled[0], outcome.out);
    if (polled[1].fd >= 0 && polled[1].revents != 0) gather(polled[1], outcome.err);
  }
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0) {
  }
  pid_ = -1;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

CloseWatch::CloseWatch(const std::filesystem::path& file) : descriptor_(inotify_init1(IN_CLOEXEC)) {
  if (inotify_add_watch(descriptor_, file.c_str(), IN_CLOSE_NOWRITE) < 0) throw std::runtime_error("inotify");
}

CloseWatch::~CloseWatch() {
  close(descriptor_);
}

void CloseWatch::wait() const {
  std::array<char, 4096> event{};
  if (read(descriptor_, event.data(), event.size()) <= 0) throw std::runtime_error("inotify");
}

}  // namespace pdsm
