// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "file_bytes.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "random_map.h"

namespace pdsm {
namespace {

using testing::Bytes;

/// A map whose file is small enough to try everything on it.
PenumbraMap small_map(std::uint64_t seed = 1) {
  testing::MapShape shape;
  shape.width = 3;
  shape.height = 2;
  shape.samples = 1;
  shape.most_vertices = 4;
  return testing::random_map(seed, shape);
}

/// read_map throws an input error, and check_map agrees with it.
void expect_refused(const Bytes& bytes) {
  // A vector of its own, so that a sanitizer sees each byte read behind the end.
  const Bytes copy(bytes.begin(), bytes.end());
  try {
    static_cast<void>(read_map(copy, "memory"));
    ADD_FAILURE() << "a damaged file was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::input);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
  EXPECT_FALSE(check_map(copy).empty());
}

/// Damage that the checksums don't show: refused, or a map that holds all invariants.
void expect_refused_or_valid(const Bytes& bytes) {
  const Bytes copy(bytes.begin(), bytes.end());
  const bool is_good = check_map(copy).empty();
  try {
    const PenumbraMap map = read_map(copy, "memory");
    EXPECT_TRUE(is_good);
    EXPECT_EQ(find_invariant_fault(map), "");
    EXPECT_EQ(read_map(serialize_map(map), "again"), map);
  } catch (const Error& error) {
    EXPECT_FALSE(is_good) << error.what();
    EXPECT_EQ(error.failure(), Failure::input) << error.what();
  }
}

class Damage : public ::testing::TestWithParam<Compression> {
 protected:
  [[nodiscard]] static Bytes small_file(std::uint64_t seed = 1) {
    return serialize_map(small_map(seed), {GetParam()});
  }
};

TEST_P(Damage, EveryTruncationIsRefused) {
  const Bytes file = small_file();
  for (std::size_t size = 0; size < file.size(); ++size) {
    SCOPED_TRACE(size);
    expect_refused(Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size)));
  }
}

TEST_P(Damage, EveryRepairedTruncationIsRefused) {
  const Bytes file = small_file();
  for (std::size_t size = testing::kHeaderSize; size < file.size(); ++size) {
    SCOPED_TRACE(size);
    Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
    testing::put<std::uint64_t>(cut, testing::kFileSizeAt, size);
    testing::repair_checksums(cut);
    expect_refused(cut);
  }
}

TEST_P(Damage, OneByteTooManyIsRefused) {
  Bytes file = small_file();
  file.push_back(std::byte{0});
  expect_refused(file);
  testing::put<std::uint64_t>(file, testing::kFileSizeAt, file.size());
  testing::repair_checksums(file);
  expect_refused(file);
}

TEST_P(Damage, EverySingleBitFlipIsRefused) {
  Bytes file = small_file();
  for (std::size_t bit = 0; bit < file.size() * 8; ++bit) {
    SCOPED_TRACE(bit);
    file[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    expect_refused(file);
    file[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
  }
  EXPECT_TRUE(check_map(file).empty());
}

TEST_P(Damage, EveryRepairedBitFlipIsRefusedOrValid) {
  const Bytes file = small_file();
  for (std::size_t bit = 0; bit < file.size() * 8; ++bit) {
    SCOPED_TRACE(bit);
    Bytes flipped = file;
    flipped[bit / 8] ^= static_cast<std::byte>(1 << bit % 8);
    testing::repair_checksums(flipped);
    expect_refused_or_valid(flipped);
  }
}

TEST_P(Damage, RandomDamageIsRefusedOrValid) {
  testing::Random random(11);
  for (int round = 0; round < 3000; ++round) {
    SCOPED_TRACE(round);
    Bytes file = small_file(1 + random.below(20));
    // A tenth of the bytes, or a single one, so that deep checks are reached as well.
    const double share = random.chance(0.5) ? 0.1 : 1.0 / static_cast<double>(file.size());
    for (std::byte& byte : file)
      if (random.chance(share)) byte = static_cast<std::byte>(random.below(256));
    expect_refused_or_valid(file);
    testing::repair_checksums(file);
    expect_refused_or_valid(file);
  }
}

TEST_P(Damage, RandomPayloadsAreRefusedOrValid) {
  testing::Random random(12);
  for (int round = 0; round < 2000; ++round) {
    SCOPED_TRACE(round);
    const Bytes file = small_file(1 + random.below(20));
    Bytes stored(random.below(120));
    const bool sparse = random.chance(0.5);
    for (std::byte& byte : stored)
      byte = static_cast<std::byte>(sparse && random.chance(0.8) ? 0 : random.below(256));
    expect_refused_or_valid(testing::replace_chunk(file, random.below(testing::chunk_count(file)), stored));
  }
}

TEST(EmptyFile, IsRefused) {
  expect_refused({});
}

INSTANTIATE_TEST_SUITE_P(Encodings, Damage, ::testing::Values(Compression::none, Compression::zstd),
                         [](const auto& instance) {
                           return instance.param == Compression::none ? "raw" : "zstd";
                         });

}  // namespace
}  // namespace pdsm
