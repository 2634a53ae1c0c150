// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/gnuplot.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "pdsm/format/error.h"

extern char** environ;

namespace pdsm {
namespace {

[[noreturn]] void fail(const std::string& reason) {
  throw Error(Failure::resource, "gnuplot", reason);
}

std::string message_of(int error) {
  return std::error_code(error, std::generic_category()).message();
}

/// A file without a name, gone when closed: unlike a pipe it can't fill up while nobody reads.
class ScratchFile {
 public:
  ScratchFile() : file_(std::tmpfile()) {
    if (!file_) fail("no temporary file: " + message_of(errno));
  }
  [[nodiscard]] int descriptor() const { return fileno(file_.get()); }

  void write(const std::string& text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size();
    if (!written || std::fflush(file_.get()) != 0) fail("temporary file: " + message_of(errno));
    std::rewind(file_.get());
  }
  [[nodiscard]] std::string read_all() {
    std::rewind(file_.get());
    std::string text;
    std::array<char, 1 << 16> buffer{};
    while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), file_.get()))
      text.append(buffer.data(), got);
    return text;
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

/// Where a child's standard streams go.
class StreamActions {
 public:
  StreamActions(int in, int out, int err) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, out, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, err, STDERR_FILENO);
  }
  ~StreamActions() { posix_spawn_file_actions_destroy(&actions_); }
  StreamActions(const StreamActions&) = delete;
  StreamActions& operator=(const StreamActions&) = delete;

  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// The first line that says something.
std::string first_line(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n");
  return begin == std::string::npos ? "failed" : text.substr(begin, text.find('\n', begin) - begin);
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  ScratchFile in, out, err;
  in.write(script);
  const StreamActions streams(in.descriptor(), out.descriptor(), err.descriptor());
  char name[] = "gnuplot";
  char* argv[] = {name, nullptr};
  pid_t pid = -1;
  const int error = posix_spawnp(&pid, name, streams.get(), nullptr, argv, environ);
  if (error == ENOENT) fail("is not in PATH, and plots need it (Debian: gnuplot-nox)");
  if (error != 0) fail(message_of(error));
  int status = 0;
  while (waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) fail(message_of(errno));
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail(first_line(err.read_all()));
  return out.read_all();
}

void require_gnuplot() {
  (void)run_gnuplot("set terminal svg\n");
}

}  // namespace pdsm
