// SPDX-License-Identifier: Apache-2.0
#include "messages.h"

#include "cli/streams.h"

namespace pdsm {
namespace {

constexpr std::chrono::seconds kShownFor{10};
constexpr std::size_t kMostShown = 5;

}  // namespace

const std::deque<Messages::Message>& Messages::recent() {
  const auto now = std::chrono::steady_clock::now();
  while (!messages_.empty() && (now - messages_.front().since > kShownFor || messages_.size() > kMostShown)) {
    messages_.pop_front();
  }
  return messages_;
}

void Messages::add(const std::string& text, bool is_fault) {
  write_error_line(text);
  messages_.push_back({text, is_fault, std::chrono::steady_clock::now()});
}

}  // namespace pdsm
