// SPDX-License-Identifier: Apache-2.0
#include "cli/guarded_main.h"

#include <exception>
#include <new>
#include <string>

#include "cli/interrupt.h"
#include "cli/streams.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

int report(const std::string& line, Failure failure) {
  write_error_line(line);
  return static_cast<int>(failure);
}

}  // namespace

int guarded_main(const std::function<int()>& run) {
  prepare_streams();
  install_interrupt_handler();
  try {
    const int code = run();
    flush_results();
    return code;
  } catch (const Error& error) {
    return report(error.what(), error.failure());
  } catch (const std::bad_alloc&) {
    return report("memory: not enough", Failure::resource);
  } catch (const std::exception& error) {
    return report(error.what(), Failure::resource);
  }
}

}  // namespace pdsm
