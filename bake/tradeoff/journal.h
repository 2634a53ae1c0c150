// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tradeoff/measurement.h"

namespace pdsm {

/// What a sweep has measured so far, on disk: a first line that says of what, then a line of JSON a
/// measurement. Lines are appended and synced, so that a killed sweep goes on where it was; what a line that
/// was cut off held is measured again.
class Journal {
 public:
  /// Opens `path`, made when it is not there. `identity` is all that measurements depend on besides their
  /// settings: a journal of another identity is emptied. Throws Error (resource) when it can't be written.
  Journal(std::filesystem::path path, const nlohmann::ordered_json& identity);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Those of earlier runs, then those of this one.
  [[nodiscard]] const std::vector<Measurement>& measurements() const { return measurements_; }
  [[nodiscard]] const Measurement* find(const TradeoffSetting& setting) const;
  /// How many were there when it was opened.
  [[nodiscard]] std::size_t earlier() const { return earlier_; }

  /// Appends one. Throws Error (resource) when it can't be written.
  void append(const Measurement& measurement);

 private:
  void read_back(const std::string& contents, const std::string& header);
  void write_line(const std::string& line);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::size_t earlier_ = 0;
  std::vector<Measurement> measurements_;
};

}  // namespace pdsm
