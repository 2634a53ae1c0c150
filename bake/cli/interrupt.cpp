// SPDX-License-Identifier: Apache-2.0
#include "cli/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include "pdsm/format/atomic_file.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

// A signal handler can reach nothing but such globals.
volatile sig_atomic_t polled = 0;
volatile sig_atomic_t seen = 0;

void handle_signal(int) {
  if (polled != 0 && seen == 0) {
    seen = 1;
    return;
  }
  AtomicFile::remove_temporaries();
  _exit(static_cast<int>(Failure::interrupted));
}

}  // namespace

void install_interrupt_handler() {
  struct sigaction action {};
  action.sa_handler = handle_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

PolledInterrupts::PolledInterrupts() {
  polled = 1;
}

PolledInterrupts::~PolledInterrupts() {
  polled = 0;
}

bool PolledInterrupts::interrupted() {
  return seen != 0;
}

}  // namespace pdsm
