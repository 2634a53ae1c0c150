// SPDX-License-Identifier: Apache-2.0
#include <exception>
#include <new>
#include <optional>
#include <string>

#include "application.h"
#include "arguments.h"
#include "cli/interrupt.h"
#include "cli/streams.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

void run_viewer(const Arguments& arguments) {
  Application application(arguments);
  if (arguments.screenshot) {
    application.run_for_screenshot();
  } else {
    application.run();
  }
}

int report(const std::string& line, Failure failure) {
  write_error_line(line);
  return static_cast<int>(failure);
}

/// The one place where failures become exit codes.
int guarded_main(int argc, char** argv) {
  try {
    const std::optional<Arguments> arguments = parse_arguments(argc, argv);
    if (arguments) run_viewer(*arguments);
    flush_results();
    return 0;
  } catch (const Error& error) {
    return report(error.what(), error.failure());
  } catch (const std::bad_alloc&) {
    return report("memory: not enough", Failure::resource);
  } catch (const std::exception& error) {
    return report(error.what(), Failure::resource);
  }
}

}  // namespace
}  // namespace pdsm

int main(int argc, char** argv) {
  pdsm::prepare_streams();
  pdsm::install_interrupt_handler();
  return pdsm::guarded_main(argc, argv);
}
