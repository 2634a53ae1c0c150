// SPDX-License-Identifier: Apache-2.0
#include "pdsm/format/error.h"

#include <gtest/gtest.h>

namespace pdsm {
namespace {

TEST(Error, IsOneLineWhateverItQuotes) {
  const Error error(Failure::input, "a\rb\n\v.ply", "no\tsuch \x1b[31m\x7f file of 3 \u20ac");
  EXPECT_STREQ(error.what(), "a b  .ply: no such  [31m  file of 3 \u20ac");
  EXPECT_EQ(error.failure(), Failure::input);
}

TEST(Error, NamesNoPlaceWhereThereIsNone) {
  EXPECT_STREQ(Error(Failure::usage, "", "no\nroom").what(), "no room");
}

}  // namespace
}  // namespace pdsm
