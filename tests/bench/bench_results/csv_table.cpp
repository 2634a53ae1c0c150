// SPDX-License-Identifier: Apache-2.0
#include "csv_table.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace pdsm::bench {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

std::string join(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() ? "" : ",") + cell;
  return line + "\n";
}

}  // namespace

const std::string& CsvTable::cell(std::size_t row, const std::string& column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end()) throw std::out_of_range("no column " + column);
  return rows.at(row).at(static_cast<std::size_t>(found - columns.begin()));
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  return std::stod(cell(row, column));
}

std::size_t CsvTable::find(const std::vector<std::pair<std::string, std::string>>& key) const {
  std::string wanted;
  for (const auto& [column, value] : key) wanted += " " + column + "=" + value;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto holds = [&](const auto& part) { return cell(row, part.first) == part.second; };
    if (std::all_of(key.begin(), key.end(), holds)) return row;
  }
  throw std::out_of_range("no row" + wanted);
}

CsvTable read_csv(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error(path.string() + ": can't be read");
  CsvTable table{split(line), {}};
  while (std::getline(file, line)) table.rows.push_back(split(line));
  return table;
}

void write_csv(const CsvTable& table, const std::filesystem::path& path) {
  std::ofstream file(path);
  file << join(table.columns);
  for (const auto& row : table.rows) file << join(row);
  if (!file.flush()) throw std::runtime_error(path.string() + ": can't be written");
}

}  // namespace pdsm::bench
