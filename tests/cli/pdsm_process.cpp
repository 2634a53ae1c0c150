// SPDX-License-Identifier: Apache-2.0
#include "pdsm_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace pdsm {
namespace {

constexpr unsigned kTimeLimit = 120;  // seconds
constexpr unsigned kNobody = 65534;

/// Both ends of a pipe, closed when it goes.
struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe");
    read = ends[0];
    write = ends[1];
  }
  ~Pipe() {
    close_end(read);
    close_end(write);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  static void close_end(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }

  int read = -1, write = -1;
};

std::vector<char*> make_argv(const std::vector<std::string>& arguments) {
  static char binary[] = PDSM_BINARY;
  std::vector<char*> argv{binary};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  return argv;
}

/// In the child: becomes pdsm, or ends with kNotRun.
[[noreturn]] void become_pdsm(const std::vector<char*>& argv, const RunSetup& setup, int in, int out,
                              int err) {
  alarm(kTimeLimit);
  signal(SIGPIPE, SIG_DFL);
  dup2(in, STDIN_FILENO);
  dup2(err, STDERR_FILENO);
  if (setup.out == Stdout::full) out = open("/dev/full", O_WRONLY | O_CLOEXEC);
  if (setup.out == Stdout::closed) {
    close(STDOUT_FILENO);
  } else {
    dup2(out, STDOUT_FILENO);
  }
  const rlimit limit{setup.file_limit, setup.file_limit};
  if (setup.file_limit > 0 && setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(kNotRun);
  const bool ready = setup.folder.empty() || chdir(setup.folder.c_str()) == 0;
  const bool rights = !setup.unprivileged || geteuid() != 0 || (setgid(kNobody) == 0 && setuid(kNobody) == 0);
  if (ready && rights) execv(argv.front(), argv.data());
  _exit(kNotRun);
}

int exit_code_of(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Feeds `input` and gathers both outputs until they end.
void converse(Pipe& in, Pipe& out, Pipe& err, const std::string& input, Outcome& outcome) {
  fcntl(in.write, F_SETFL, O_NONBLOCK);
  std::size_t written = 0;
  std::array<pollfd, 3> polled{{{in.write, POLLOUT, 0}, {out.read, POLLIN, 0}, {err.read, POLLIN, 0}}};
  const auto gather = [](pollfd& from, std::string& to) {
    std::array<char, 4096> buffer{};
    const ssize_t got = read(from.fd, buffer.data(), buffer.size());
    if (got > 0) to.append(buffer.data(), static_cast<std::size_t>(got));
    if (got <= 0) from.fd = -1;
  };
  while (polled[1].fd >= 0 || polled[2].fd >= 0) {
    poll(polled.data(), polled.size(), -1);
    if (polled[0].fd >= 0 && polled[0].revents != 0) {
      const ssize_t put =
          written < input.size() ? write(in.write, input.data() + written, input.size() - written) : 0;
      written += put > 0 ? static_cast<std::size_t>(put) : 0;
      if (put < 0 || written == input.size()) {
        polled[0].fd = -1;
        Pipe::close_end(in.write);
      }
    }
    if (polled[1].fd >= 0 && polled[1].revents != 0) gather(polled[1], outcome.out);
    if (polled[2].fd >= 0 && polled[2].revents != 0) gather(polled[2], outcome.err);
  }
}

/// A field of /proc/PID/status, or nothing.
std::string status_field(pid_t pid, const std::string& name) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string word, value; status >> word;) {
    if (word == name && status >> value) return value;
  }
  return {};
}

/// Processor time of a process so far.
double cpu_seconds(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string skipped;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// Asks until `done` says so; false when the process has ended or the time limit has passed.
template <typename Done>
bool wait_until(pid_t pid, Done&& done) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(kTimeLimit);
  while (std::chrono::steady_clock::now() < limit) {
    if (done()) return true;
    const std::string state = status_field(pid, "State:");
    if (state.empty() || state == "Z") return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace

Outcome run_pdsm(const std::vector<std::string>& arguments, const RunSetup& setup) {
  signal(SIGPIPE, SIG_IGN);
  const std::vector<char*> argv = make_argv(arguments);
  Pipe in, out, err;
  if (setup.out == Stdout::broken_pipe) Pipe::close_end(out.read);
  const pid_t pid = fork();
  if (pid == 0) become_pdsm(argv, setup, in.read, out.write, err.write);
  Pipe::close_end(in.read);
  Pipe::close_end(out.write);
  Pipe::close_end(err.write);
  Outcome outcome;
  converse(in, out, err, setup.input, outcome);
  outcome.exit_code = exit_code_of(pid);
  return outcome;
}

RunningPdsm::RunningPdsm(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
  const std::vector<char*> argv = make_argv(arguments);
  Pipe in, out;
  RunSetup setup;
  setup.folder = folder;
  const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
  pid_ = fork();
  if (pid_ == 0) become_pdsm(argv, setup, in.read, out.write, null);
  close(null);
  std::swap(stdin_, in.write);
  std::swap(stdout_, out.read);
}

RunningPdsm::~RunningPdsm() {
  Pipe::close_end(stdin_);
  Pipe::close_end(stdout_);
  if (pid_ < 0) return;
  send(SIGKILL);
  (void)wait();
}

bool RunningPdsm::wait_for_handler(int signal) const {
  return wait_until(pid_, [&] {
    const std::string caught = status_field(pid_, "SigCgt:");
    return !caught.empty() && (std::stoull(caught, nullptr, 16) >> (signal - 1) & 1) != 0;
  });
}

bool RunningPdsm::wait_for_cpu_seconds(double seconds) const {
  return wait_until(pid_, [&] { return cpu_seconds(pid_) >= seconds; });
}

bool RunningPdsm::wait_for_file(const std::filesystem::path& file, std::uintmax_t bytes) const {
  return wait_until(pid_, [&] {
    std::error_code missing;
    const std::uintmax_t size = std::filesystem::file_size(file, missing);
    return !missing && size >= bytes;
  });
}

void RunningPdsm::send(int signal) const {
  kill(pid_, signal);
}

void RunningPdsm::say(const std::string& text) const {
  if (write(stdin_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    throw std::runtime_error("write");
  }
}

std::string RunningPdsm::hear_line() const {
  std::string line;
  for (char c = 0; read(stdout_, &c, 1) == 1 && c != '\n';) line += c;
  return line;
}

int RunningPdsm::wait() {
  const int code = exit_code_of(pid_);
  pid_ = -1;
  return code;
}

}  // namespace pdsm
