// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "application.h"
#include "arguments.h"
#include "cli/guarded_main.h"

namespace pdsm {
namespace {

int run_viewer(int argc, char** argv) {
  const std::optional<Arguments> arguments = parse_arguments(argc, argv);
  if (!arguments) return 0;
  Application application(*arguments);
  if (arguments->screenshot) {
    application.run_for_screenshot();
  } else {
    application.run();
  }
  return 0;
}

}  // namespace
}  // namespace pdsm

int main(int argc, char** argv) {
  return pdsm::guarded_main([&] { return pdsm::run_viewer(argc, argv); });
}
