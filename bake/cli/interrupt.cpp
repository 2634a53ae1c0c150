// SPDX-License-Identifier: Apache-2.0
#include "cli/interrupt.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <cstring>

#include "pdsm/format/atomic_file.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

// A signal handler can reach nothing but such globals.
volatile sig_atomic_t polled = 0;
volatile sig_atomic_t seen = 0;

/// How long work that polls may take to unwind: with this, a signal ends the process within a second.
constexpr long kPatienceNanoseconds = 800'000'000;
timer_t patience;
bool has_patience = false;

/// 0 stops the timer.
void start_patience(long nanoseconds) {
  if (!has_patience) return;
  itimerspec time{};
  time.it_value.tv_nsec = nanoseconds;
  timer_settime(patience, 0, &time, nullptr);
}

[[noreturn]] void end_process() {
  AtomicFile::remove_temporaries();
  _exit(static_cast<int>(Failure::interrupted));
}

void handle_signal(int) {
  if (polled == 0 || seen != 0) end_process();
  seen = 1;
  start_patience(kPatienceNanoseconds);
}

void handle_impatience(int) {
  constexpr char kLine[] = "interrupted\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kLine, std::strlen(kLine));
  end_process();
}

}  // namespace

void install_interrupt_handler() {
  struct sigaction action {};
  action.sa_handler = handle_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  action.sa_handler = handle_impatience;
  sigaction(SIGRTMIN, &action, nullptr);
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGRTMIN;
  has_patience = timer_create(CLOCK_MONOTONIC, &event, &patience) == 0;
}

PolledInterrupts::PolledInterrupts() {
  polled = 1;
}

PolledInterrupts::~PolledInterrupts() {
  start_patience(0);
  polled = 0;
}

bool PolledInterrupts::interrupted() {
  return seen != 0;
}

}  // namespace pdsm
