// SPDX-License-Identifier: Apache-2.0
#include "cli/point_lines.h"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <vector>

#include "cli/streams.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

/// No three numbers need more; keeps memory bounded on input without line ends.
constexpr std::size_t kLongestLine = 4096;
constexpr std::size_t kReadSize = 1 << 16;

/// Takes the next blank-separated word off `line`; empty when there is none.
std::string_view take_word(std::string_view& line) {
  constexpr std::string_view kBlanks = " \t";
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

double parse_coordinate(std::string_view word, const std::string& where) {
  if (word.empty()) throw Error(Failure::input, where, "expected three numbers \"x y z\"");
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    throw Error(Failure::input, where, "'" + std::string(word.substr(0, 40)) + "' is not a finite number");
  }
  return value;
}

/// What has been read but not answered.
class PendingLines {
 public:
  /// Reads more of stdin; false at its end, then a last line without an end of line counts as one.
  bool read_more() {
    const std::size_t size = text_.size();
    text_.resize(size + kReadSize);
    ssize_t got = 0;
    do {
      got = read(STDIN_FILENO, text_.data() + size, kReadSize);
    } while (got < 0 && errno == EINTR);
    if (got < 0) throw Error(Failure::input, "stdin", std::strerror(errno));
    text_.resize(size + static_cast<std::size_t>(got));
    if (got == 0 && !text_.empty()) text_ += '\n';
    return got > 0;
  }

  /// Takes the points of all complete lines; stops in front of a bad one and keeps its fault.
  std::vector<glm::dvec3> take_points() {
    std::vector<glm::dvec3> points;
    std::size_t begin = 0;
    try {
      for (std::size_t end = 0; (end = text_.find('\n', begin)) != std::string::npos; begin = end + 1) {
        ++line_;
        points.push_back(parse_point(std::string_view(text_).substr(begin, end - begin), where()));
      }
      text_.erase(0, begin);
      if (text_.size() > kLongestLine) {
        ++line_;
        throw Error(Failure::input, where(), "the line is too long");
      }
    } catch (const Error&) {
      fault_ = std::current_exception();
    }
    return points;
  }

  void throw_fault() const {
    if (fault_) std::rethrow_exception(fault_);
  }

 private:
  [[nodiscard]] std::string where() const { return "stdin:" + std::to_string(line_); }

  std::string text_;
  std::uint64_t line_ = 0;
  std::exception_ptr fault_;
};

}  // namespace

glm::dvec3 parse_point(std::string_view line, const std::string& where) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  glm::dvec3 point(0);
  for (int axis = 0; axis < 3; ++axis) point[axis] = parse_coordinate(take_word(line), where);
  const std::string_view rest = take_word(line);
  if (!rest.empty()) {
    throw Error(Failure::input, where, "'" + std::string(rest.substr(0, 40)) + "' after three numbers");
  }
  return point;
}

void answer_point_lines(const AnswerPoints& answer) {
  PendingLines pending;
  std::string lines;
  for (bool more = true; more;) {
    more = pending.read_more();
    const std::vector<glm::dvec3> points = pending.take_points();
    lines.clear();
    answer(points, lines);
    write_result(lines);
    flush_results();
    pending.throw_fault();
  }
}

}  // namespace pdsm
