// SPDX-License-Identifier: Apache-2.0
#include "fault_expectation.h"

#include <gtest/gtest.h>

#include "pdsm/format/error.h"
#include "random_map.h"

namespace pdsm::testing {

PenumbraMap sample_map() {
  MapShape shape;
  shape.width = 66;
  shape.height = 2;
  shape.empty_share = 0;
  shape.most_vertices = 3;
  return random_map(21, shape);
}

Bytes sample_file(Compression compression) {
  return serialize_map(sample_map(), {compression});
}

std::size_t payload_at(const Bytes& file, const std::string& type, std::size_t inside) {
  return get<std::uint64_t>(file, entry_at(find_chunk(file, type)) + kOffsetIn) + inside;
}

void expect_fault(Bytes file, int number, std::uint64_t offset, bool repair) {
  if (repair) repair_checksums(file);
  const auto faults = check_map(file);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front().number, number) << faults.front().expected;
  EXPECT_EQ(faults.front().offset, offset);
  EXPECT_FALSE(faults.front().expected.empty());
  try {
    static_cast<void>(read_map(file, "name"));
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    const std::string start =
        "name:offset " + std::to_string(offset) + ": fault " + std::to_string(number) + ": expected ";
    EXPECT_EQ(std::string(error.what()).substr(0, start.size()), start);
    EXPECT_EQ(error.failure(), Failure::input);
  }
}

}  // namespace pdsm::testing
