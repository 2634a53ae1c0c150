// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>

namespace pdsm {

/// "x y z", blanks between, an end of CR allowed. Throws Error (input) "where: reason" for anything else.
[[nodiscard]] glm::dvec3 parse_point(std::string_view line, const std::string& where);

/// Turns points into one line of text each, appended to `lines`.
using AnswerPoints = std::function<void(std::span<const glm::dvec3> points, std::string& lines)>;

/// One line in, one line out: reads points from stdin to its end and writes the answers to stdout. Answers
/// to what has arrived are written before more is waited for, so a program may talk to it over two pipes.
/// At a bad line, the lines before it are answered, then Error (input) "stdin:LINE: reason" is thrown.
void answer_point_lines(const AnswerPoints& answer);

}  // namespace pdsm
