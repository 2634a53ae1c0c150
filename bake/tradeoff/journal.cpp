// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>
#include <utility>

#include "pdsm/format/atomic_file.h"
#include "pdsm/format/error.h"

namespace pdsm {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw Error(Failure::resource, path.string(), std::error_code(errno, std::generic_category()).message());
}

/// Empty when there is none, or no file that can hold any.
std::string read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string line_of(const Measurement& measurement) {
  return to_json(measurement).dump() + "\n";
}

}  // namespace

Journal::Journal(std::filesystem::path path, const Json& identity) : path_(std::move(path)) {
  const std::string header = Json{{"journal", identity}}.dump() + "\n";
  const std::string contents = read_file(path_);
  read_back(contents, header);
  earlier_ = measurements_.size();
  std::string kept = header;
  for (const Measurement& measurement : measurements_) kept += line_of(measurement);
  if (kept != contents) {
    AtomicFile file(path_);
    file.write(std::as_bytes(std::span(kept)));
    file.commit();
  }
  descriptor_ = open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ < 0) fail(path_);
}

Journal::~Journal() {
  if (descriptor_ >= 0) close(descriptor_);
}

void Journal::read_back(const std::string& contents, const std::string& header) {
  if (!contents.starts_with(header)) return;
  // A line without its end was cut off, whatever it holds; what follows a line that can't be read is void.
  std::size_t begin = header.size();
  for (std::size_t end; (end = contents.find('\n', begin)) != std::string::npos; begin = end + 1) {
    try {
      measurements_.push_back(measurement_of(Json::parse(contents.substr(begin, end - begin))));
    } catch (const Json::exception&) {
      return;
    }
  }
}

const Measurement* Journal::find(const TradeoffSetting& setting) const {
  const auto found = std::find_if(measurements_.begin(), measurements_.end(),
                                  [&](const Measurement& m) { return m.setting == setting; });
  return found == measurements_.end() ? nullptr : &*found;
}

void Journal::append(const Measurement& measurement) {
  write_line(line_of(measurement));
  measurements_.push_back(measurement);
}

void Journal::write_line(const std::string& line) {
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t written = write(descriptor_, line.data() + done, line.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path_);
    done += static_cast<std::size_t>(written);
  }
  if (fsync(descriptor_) != 0) fail(path_);
}

}  // namespace pdsm
