// SPDX-License-Identifier: Apache-2.0
// The cheap look at a file: its metadata where all checksums hold, nothing otherwise.
#include <gtest/gtest.h>

#include "pdsm/format/map_file.h"
#include "random_map.h"
#include "scratch_folder.h"

namespace pdsm {
namespace {

class ReadMetadata : public ::testing::Test {
 protected:
  ReadMetadata() {
    PenumbraMap map = testing::random_map(71);
    map.metadata = R"({"key": "0123"})";
    bytes_ = serialize_map(map);
  }

  [[nodiscard]] std::optional<std::string> read(std::span<const std::byte> bytes) const {
    testing::put_file(path_, bytes);
    return read_metadata(path_);
  }

  std::vector<std::byte> bytes_;
  testing::ScratchFolder folder_;
  std::filesystem::path path_ = folder_.path() / "map.pdsm";
};

TEST_F(ReadMetadata, OfAWholeFile) {
  EXPECT_EQ(read(bytes_), R"({"key": "0123"})");
}

TEST_F(ReadMetadata, NothingOfWhatIsNoMap) {
  EXPECT_EQ(read_metadata(path_), std::nullopt);
  EXPECT_EQ(read_metadata(folder_.path()), std::nullopt);
  EXPECT_EQ(read({}), std::nullopt);
  EXPECT_EQ(read(std::as_bytes(std::span("text"))), std::nullopt);
}

TEST_F(ReadMetadata, NothingOfADamagedFile) {
  for (std::size_t n = 0; n < bytes_.size(); ++n) {
    std::vector<std::byte> damaged = bytes_;
    damaged[n] ^= std::byte{1};
    ASSERT_EQ(read(damaged), std::nullopt) << "byte " << n;
  }
  for (const std::size_t size : {bytes_.size() - 1, bytes_.size() / 2, std::size_t{48}, std::size_t{1}})
    EXPECT_EQ(read(std::span(bytes_).first(size)), std::nullopt) << size;
}

}  // namespace
}  // namespace pdsm
