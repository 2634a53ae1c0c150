// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <deque>
#include <string>

namespace pdsm {

/// What the viewer tells the person: a line on stderr at once, and for some seconds in the window.
class Messages {
 public:
  struct Message {
    std::string text;
    bool is_fault = false;
    std::chrono::steady_clock::time_point since;
  };

  void note(const std::string& text) { add(text, false); }
  void fault(const std::string& text) { add(text, true); }

  /// Those that are still to be shown, oldest first.
  [[nodiscard]] const std::deque<Message>& recent();

 private:
  void add(const std::string& text, bool is_fault);

  std::deque<Message> messages_;
};

}  // namespace pdsm
