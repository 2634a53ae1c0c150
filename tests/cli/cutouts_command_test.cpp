// SPDX-License-Identifier: Apache-2.0
// A grate over a floor, cut out of a texture, through all commands that look at it.
#include <nlohmann/json.hpp>

#include "scratch_scene.h"
#include "test_pictures.h"

namespace pdsm {
namespace {

class CutoutsCommand : public ScratchScene {
 protected:
  CutoutsCommand() {
    // A hole of 8 x 8 texels in 16 x 16, so of 1 x 1 m in the middle of the plate of 2 x 2 m.
    std::vector<std::uint8_t> pixels;
    for (int n = 0; n < 256; ++n) {
      const int i = n % 16, j = n / 16;
      pixels.push_back(i >= 4 && i < 12 && j >= 4 && j < 12 ? 0 : 1);
    }
    write_file("grate.png", test::palette_png(16, 16, pixels, {0, 255}));
    write_file("grate.mtl", "newmtl grate\nmap_d grate.png\n");
    write_file(
        "grate.obj",
        "mtllib grate.mtl\nusemtl grate\nv -1 1 -1\nv -1 1 1\nv 1 1 1\nv 1 1 -1\nvt 0 0\nvt 0 1\nvt 1 1\n"
        "vt 1 0\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
    std::string scene = contents("one.scene.json");
    scene.replace(scene.find("plate.obj"), 9, "grate.obj");
    write_file("grate.scene.json", scene);
  }

  [[nodiscard]] Outcome bake(std::vector<std::string> extra = {}) const {
    std::vector<std::string> arguments{"bake", "grate.scene.json", "-o", "map.pdsm", "--samples",
                                       "64",   "--resolution",     "96"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    return run(arguments);
  }
};

TEST_F(CutoutsCommand, FromBakeToPicture) {
  ASSERT_EQ(bake({"--quiet", "--report", "report.json"}).exit_code, 0);
  bool named = false;
  const auto report = nlohmann::json::parse(contents("report.json"));
  for (const auto& feature : report["modelled"])
    named = named || (feature["feature"] == "cutouts" && feature["modelled"] == true);
  EXPECT_TRUE(named);
  EXPECT_NE(run({"info", "map.pdsm"}).out.find("modelled   cutouts: casters have holes"), std::string::npos);
  // The light at 4 m is 1 m wide, the grate lies at 1 m: below the hole's middle all of it is seen, below the
  // grate's edge none.
  for (const auto& [point, expected] : {std::pair{"0 0.01 0", 0.0}, {"1.02 0.01 0", 1.0}}) {
    EXPECT_EQ(value({"query", "map.pdsm"}, point), expected) << point;
    EXPECT_EQ(value({"truth", "grate.scene.json", "--samples", "256"}, point), expected) << point;
  }
  // Errors come from texels of 0.06 m at most, in penumbrae of 1/3 m: half a texel's share, all points alike.
  const Outcome verified = run({"verify", "map.pdsm", "grate.scene.json", "--points", "400", "--samples",
                                "256", "--max-error", "0.09"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
  ASSERT_EQ(run({"render", "map.pdsm", "grate.scene.json", "-o", "a.png", "--size", "48x36"}).exit_code, 0);
  ASSERT_EQ(run({"render", "grate.scene.json", "--truth", "--truth-samples", "16", "-o", "b.png", "--size",
                 "48x36"})
                .exit_code,
            0);
  // Without its hole, the picture is another.
  write_file("grate.mtl", "newmtl grate\n");
  ASSERT_EQ(run({"render", "grate.scene.json", "--truth", "--truth-samples", "16", "-o", "c.png", "--size",
                 "48x36"})
                .exit_code,
            0);
  EXPECT_FALSE(contents("b.png") == contents("c.png"));
}

TEST_F(CutoutsCommand, DryRunWritesNothing) {
  EXPECT_EQ(bake({"--dry-run"}).exit_code, 0);
  EXPECT_FALSE(exists("map.pdsm"));
}

TEST_F(CutoutsCommand, MergedShardsAreTheBake) {
  ASSERT_EQ(bake({"--quiet"}).exit_code, 0);
  const std::string whole = contents("map.pdsm");
  for (const std::string share : {"1", "2"})
    ASSERT_EQ(run({"bake", "grate.scene.json", "-o", share + ".shard", "--light", "key", "--shard",
                   share + "/2", "--samples", "64", "--resolution", "96", "--quiet"})
                  .exit_code,
              0);
  ASSERT_EQ(run({"merge", "1.shard", "2.shard", "-o", "merged.pdsm", "--quiet"}).exit_code, 0);
  EXPECT_TRUE(contents("merged.pdsm") == whole);
}

TEST_F(CutoutsCommand, AnotherMaskIsAnotherMap) {
  ASSERT_EQ(bake({"--quiet"}).exit_code, 0);
  const std::string first = contents("map.pdsm");
  ASSERT_EQ(bake({"--quiet"}).exit_code, 0);
  EXPECT_TRUE(contents("map.pdsm") == first);
  write_file("grate.png", test::palette_png(2, 1, {0, 1}, {0, 255}));
  ASSERT_EQ(bake({"--quiet"}).exit_code, 0);
  EXPECT_FALSE(contents("map.pdsm") == first);
}

TEST_F(CutoutsCommand, FaultsOfPictures) {
  write_file("grate.png", "no picture");
  const Outcome broken = bake();
  expect_exit(broken, 3);
  EXPECT_NE(broken.err.find("grate.obj:grate: image grate.png: is not a PNG"), std::string::npos)
      << broken.err;
  std::filesystem::remove(path("grate.png"));
  const Outcome missing = bake();
  expect_exit(missing, 3);
  EXPECT_NE(missing.err.find("grate.obj:grate: "), std::string::npos) << missing.err;
  EXPECT_NE(missing.err.find("grate.png: no such file"), std::string::npos) << missing.err;
  EXPECT_FALSE(exists("map.pdsm"));
}

}  // namespace
}  // namespace pdsm
