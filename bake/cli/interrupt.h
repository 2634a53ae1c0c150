// SPDX-License-Identifier: Apache-2.0
#pragma once

/// SIGINT and SIGTERM: no temporary file stays behind, exit code 130.
namespace pdsm {

/// Ends the process at the signal, after removing temporaries.
void install_interrupt_handler();

/// While one lives, the first signal only sets the flag that interrupted() tells; the second ends the
/// process, and so do 0.8 s in which the work has not unwound. For work that polls and unwinds by itself.
class PolledInterrupts {
 public:
  PolledInterrupts();
  ~PolledInterrupts();
  PolledInterrupts(const PolledInterrupts&) = delete;
  PolledInterrupts& operator=(const PolledInterrupts&) = delete;

  [[nodiscard]] static bool interrupted();
};

}  // namespace pdsm
