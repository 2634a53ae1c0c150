// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// What the command line writes where: results on stdout, everything else on stderr.
namespace pdsm {

/// Makes a stream that the caller closed fail on use, so that no file we open takes its number; lets
/// writes to a closed pipe return an error.
void prepare_streams();

/// Appends to stdout. Throws Error (resource) "stdout: reason" when it can't be written.
void write_result(std::string_view text);

/// Makes what was written arrive, or throws as write_result does.
void flush_results();

/// One line on stderr: "warning: text".
void write_warning(std::string_view text);

/// One line on stderr as it is; control characters become spaces, so that it stays one.
void write_error_line(std::string_view text);

}  // namespace pdsm
