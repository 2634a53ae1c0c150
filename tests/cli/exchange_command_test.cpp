// SPDX-License-Identifier: Apache-2.0
// `export`, `import` and `diff`.
#include "scratch_scene.h"

namespace pdsm {
namespace {

class Exchange : public ScratchScene {
 protected:
  Exchange() { bake_small("map.pdsm"); }
};

TEST_F(Exchange, RoundTripIsExact) {
  EXPECT_EQ(run({"export", "map.pdsm", "-o", "deep.exr"}).exit_code, 0);
  EXPECT_EQ(run({"import", "deep.exr", "-o", "back.pdsm"}).exit_code, 0);
  EXPECT_TRUE(contents("back.pdsm") == contents("map.pdsm"));
  const Outcome diff = run({"diff", "map.pdsm", "back.pdsm"});
  EXPECT_EQ(diff.exit_code, 0) << diff.out << diff.err;
}

TEST_F(Exchange, MipLevelsGoThereAndBack) {
  bake_small("mips.pdsm", {"--mip-levels", "6"});
  EXPECT_EQ(run({"export", "mips.pdsm", "-o", "deep.exr"}).exit_code, 0);
  EXPECT_EQ(run({"import", "deep.exr", "-o", "back.pdsm"}).exit_code, 0);
  EXPECT_TRUE(contents("back.pdsm") == contents("mips.pdsm"));
  const Outcome same = run({"diff", "mips.pdsm", "back.pdsm"});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_NE(same.out.find("differing texels 0 of 1365"), std::string::npos) << same.out;
  // Level 0 alone is another map.
  const Outcome other = run({"diff", "mips.pdsm", "map.pdsm", "--tolerance", "1"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.out.find("mip levels"), std::string::npos) << other.out;
  // Where the worst is, is told by level.
  bake_small("rough.pdsm", {"--mip-levels", "6", "--epsilon", "0.1"});
  EXPECT_NE(run({"diff", "mips.pdsm", "rough.pdsm"}).out.find(" level "), std::string::npos);
}

TEST_F(Exchange, RefusesBadFilesAndOutputs) {
  expect_exit(run({"export", "plate.obj", "-o", "x.exr"}), 3);
  expect_exit(run({"import", "map.pdsm", "-o", "x.pdsm"}), 3);
  expect_exit(run({"import", "missing.exr", "-o", "x.pdsm"}), 3);
  expect_exit(run({"export", "map.pdsm", "-o", "map.pdsm"}), 2);
  expect_exit(run({"export", "map.pdsm", "-o", "missing/x.exr"}), 4);
  ASSERT_EQ(run({"export", "map.pdsm", "-o", "deep.exr"}).exit_code, 0);
  expect_exit(run({"import", "deep.exr", "-o", "./deep.exr"}), 2);
  expect_exit(run({"import", "deep.exr", "-o", "missing/x.pdsm"}), 4);
  EXPECT_FALSE(exists("x.exr"));
  EXPECT_FALSE(exists("x.pdsm"));
  EXPECT_EQ(run({"check", "map.pdsm"}).exit_code, 0);
}

TEST_F(Exchange, DiffTellsMapsApart) {
  bake_small("other.pdsm", {"--seed", "1", "--points", "jittered"});
  const Outcome differs = run({"diff", "map.pdsm", "other.pdsm"});
  EXPECT_EQ(differs.exit_code, 1) << differs.err;
  EXPECT_EQ(differs.out.rfind("max difference   0.", 0), 0U) << differs.out;
  EXPECT_EQ(run({"diff", "map.pdsm", "other.pdsm", "--tolerance", "1"}).exit_code, 0);
  EXPECT_EQ(run({"diff", "map.pdsm", "other.pdsm", "--tolerance", "1e-9"}).exit_code, 1);
  EXPECT_EQ(run({"diff", "map.pdsm", "map.pdsm"}).exit_code, 0);
}

TEST_F(Exchange, DiffOfOtherViewsDoesNotHold) {
  ASSERT_EQ(
      run({"bake", "one.scene.json", "-o", "big.pdsm", "--samples", "4", "--resolution", "40"}).exit_code, 0);
  const Outcome outcome = run({"diff", "map.pdsm", "big.pdsm", "--tolerance", "1"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out.rfind("not comparable: ", 0), 0U) << outcome.out;
}

TEST_F(Exchange, DiffDraws) {
  bake_small("other.pdsm", {"--seed", "1", "--points", "jittered"});
  EXPECT_EQ(run({"diff", "map.pdsm", "other.pdsm", "-o", "diff.png"}).exit_code, 1);
  EXPECT_EQ(contents("diff.png").substr(1, 3), "PNG");
  expect_exit(run({"diff", "map.pdsm", "other.pdsm", "-o", "diff.jpg"}), 2);
  expect_exit(run({"diff", "map.pdsm", "other.pdsm", "-o", "diff.exr"}), 2);
  expect_exit(run({"diff", "map.pdsm", "other.pdsm", "-o", "missing/diff.png"}), 4);
  expect_exit(run({"diff", "map.pdsm", "plate.obj"}), 3);
}

}  // namespace
}  // namespace pdsm
