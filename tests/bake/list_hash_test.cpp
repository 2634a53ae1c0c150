// SPDX-License-Identifier: Apache-2.0
#include "tile/list_hash.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "support/random.h"

namespace pdsm::test {
namespace {

using Entry = std::array<std::uint64_t, 2>;

Entry random_entry(Random& random) {
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max() - 1;
  return {static_cast<std::uint64_t>(random.integer(0, kMost)) << 1,
          static_cast<std::uint64_t>(random.integer(0, kMost)) << 1};
}

ListHash hash_of(std::span<const Entry> entries) {
  ListHash hash;
  for (const Entry& entry : entries) hash.add(entry);
  return hash;
}

TEST(ListHash, IsThatOfItsParts) {
  Random random(5);
  std::vector<Entry> entries;
  for (int n = 0; n < 40; ++n) entries.push_back(random_entry(random));
  const ListHash whole = hash_of(entries);
  for (std::size_t cut = 0; cut <= entries.size(); ++cut) {
    ListHash parts = hash_of(std::span(entries).first(cut));
    parts.append(hash_of(std::span(entries).subspan(cut)));
    EXPECT_EQ(parts, whole) << cut;
  }
}

TEST(ListHash, TellsListsApart) {
  Random random(6);
  std::vector<Entry> entries;
  for (int n = 0; n < 20; ++n) entries.push_back(random_entry(random));
  std::set<Entry> sums{hash_of(entries).sums()};
  for (std::size_t a = 0; a < entries.size(); ++a) {
    auto less = entries;
    less.erase(less.begin() + static_cast<std::ptrdiff_t>(a));
    EXPECT_TRUE(sums.insert(hash_of(less).sums()).second);
    for (std::size_t b = 0; b < a; ++b) {
      auto swapped = entries;
      std::swap(swapped[a], swapped[b]);
      EXPECT_TRUE(sums.insert(hash_of(swapped).sums()).second) << a << ", " << b;
    }
  }
}

/// Entries of nothing but ones and zeroes are numbers modulo 2^61 - 1 like any others.
TEST(ListHash, HoldsAtTheEdges) {
  const Entry ones{~std::uint64_t{0}, ~std::uint64_t{0}}, zeroes{};
  const std::vector<Entry> all(1000, ones), none(1000, zeroes);
  EXPECT_EQ(hash_of(all).sums(), hash_of(none).sums()) << "2^61 - 1 is 0";
  EXPECT_NE(hash_of(none), hash_of(std::span(none).first(999))) << "their numbers differ";
}

}  // namespace
}  // namespace pdsm::test
