// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pdsm::bench {

/// Rows of text cells under named columns, as comma-separated values. No cell holds a comma.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  /// The cell of a row in the column of a name. Throws std::out_of_range when there is none.
  [[nodiscard]] const std::string& cell(std::size_t row, const std::string& column) const;
  [[nodiscard]] double number(std::size_t row, const std::string& column) const;
  /// The first row whose cells are `key`, column by column. Throws std::out_of_range when there is none.
  [[nodiscard]] std::size_t find(const std::vector<std::pair<std::string, std::string>>& key) const;
};

/// Throws std::runtime_error that names the file when it can't be read or written.
[[nodiscard]] CsvTable read_csv(const std::filesystem::path& path);
void write_csv(const CsvTable& table, const std::filesystem::path& path);

}  // namespace pdsm::bench
