// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "plate_scene.h"
#include "session.h"

namespace pdsm {
namespace {

/// Files dropped on a session of plate.scene.json and key.pdsm.
class Drop : public PlateScene {
 protected:
  void SetUp() override {
    PlateScene::SetUp();
    session.open(path("plate.scene.json"), {path("key.pdsm")});
  }

  void drop(const std::vector<std::string>& names) {
    std::vector<std::filesystem::path> files;
    std::transform(names.begin(), names.end(), std::back_inserter(files),
                   [](const std::string& name) { return path(name); });
    session.drop(files);
  }

  /// Fails unless exactly one fault was told, about `name`, and what was shown is shown on.
  void expect_refused(const std::string& name) {
    EXPECT_EQ(faults(), 1U);
    for (const Messages::Message& message : session.messages().recent()) {
      if (!message.is_fault) continue;
      EXPECT_NE(message.text.find(name), std::string::npos) << message.text;
    }
    EXPECT_EQ(session.stage_version(), 1U);
    EXPECT_EQ(session.map_version(), 1U);
    ASSERT_TRUE(session.stage());
    EXPECT_EQ(session.stage()->path(), path("plate.scene.json"));
    ASSERT_EQ(session.library().maps().size(), 1U);
    EXPECT_EQ(session.library().maps()[0].path, path("key.pdsm"));
  }

  [[nodiscard]] std::size_t faults() {
    const auto& messages = session.messages().recent();
    return static_cast<std::size_t>(std::count_if(
        messages.begin(), messages.end(), [](const Messages::Message& message) { return message.is_fault; }));
  }

  Session session;
};

TEST_F(Drop, AMapOfTheSameLightTakesItsPlace) {
  session.lights()[0].on = false;
  session.lights()[0].intensity = 2;
  drop({"empty.pdsm"});
  // Baked of another scene, with the same light: taken, and told.
  EXPECT_EQ(faults(), 0U);
  ASSERT_EQ(session.messages().recent().size(), 1U);
  EXPECT_NE(session.messages().recent()[0].text.find("has changed since the bake"), std::string::npos);
  ASSERT_EQ(session.library().maps().size(), 1U);
  EXPECT_EQ(session.library().maps()[0].path, path("empty.pdsm"));
  EXPECT_EQ(session.map_version(), 2U);
  EXPECT_EQ(session.stage_version(), 1U);
  EXPECT_TRUE(session.lights()[0].on);
  EXPECT_EQ(session.lights()[0].intensity, 2);
}

TEST_F(Drop, AMapOfNoLightOfTheSceneIsRefused) {
  drop({"lamp.pdsm"});
  expect_refused("lamp.pdsm");
}

TEST_F(Drop, AnotherSceneKeepsTheMapsThatFit) {
  drop({"two.scene.json"});
  EXPECT_EQ(faults(), 0U);
  EXPECT_EQ(session.stage_version(), 2U);
  EXPECT_EQ(session.stage()->path(), path("two.scene.json"));
  ASSERT_EQ(session.lights().size(), 2U);
  EXPECT_TRUE(session.lights()[0].on);
  EXPECT_FALSE(session.lights()[1].on);
  EXPECT_NE(session.library().of_light(0), nullptr);
  EXPECT_EQ(session.library().of_light(1), nullptr);
}

TEST_F(Drop, AnotherSceneLeavesOutMapsThatDoNotFit) {
  drop({"lamp.scene.json"});
  EXPECT_EQ(faults(), 0U);
  ASSERT_EQ(session.messages().recent().size(), 1U);
  EXPECT_TRUE(session.messages().recent()[0].text.ends_with("; left out"));
  EXPECT_TRUE(session.library().maps().empty());
  EXPECT_TRUE(session.lights()[0].on);
}

TEST_F(Drop, TwoFilesAtOnceComeInAnyOrder) {
  drop({"lamp.pdsm", "two.scene.json"});
  EXPECT_EQ(faults(), 0U);
  EXPECT_EQ(session.library().maps().size(), 2U);
  EXPECT_TRUE(session.lights()[0].on);
  EXPECT_TRUE(session.lights()[1].on);
}

TEST_F(Drop, GarbageIsRefused) {
  write("garbage.bin", std::string("\0\x01\xff garbage", 11));
  drop({"garbage.bin"});
  expect_refused("garbage.bin");
}

TEST_F(Drop, ADamagedMapIsRefused) {
  write("damaged.pdsm", "this is no map");
  drop({"damaged.pdsm"});
  expect_refused("damaged.pdsm");
}

TEST_F(Drop, AFolderIsRefused) {
  for (const char* name : {"folder", "folder.pdsm"}) {
    SCOPED_TRACE(name);
    std::filesystem::create_directory(path(name));
    Session fresh;
    std::swap(session, fresh);
    session.open(path("plate.scene.json"), {path("key.pdsm")});
    drop({name});
    expect_refused(name);
    std::filesystem::remove(path(name));
  }
}

TEST_F(Drop, WhatIsGoneIsRefused) {
  drop({"nothing.scene.json"});
  expect_refused("nothing.scene.json");
}

TEST_F(Drop, AFaultDoesNotKeepTheOtherFileOut) {
  write("damaged.pdsm", "this is no map");
  drop({"damaged.pdsm", "two.scene.json"});
  EXPECT_EQ(faults(), 1U);
  EXPECT_EQ(session.stage()->path(), path("two.scene.json"));
}

TEST_F(Drop, NamesMayBeOdd) {
  const std::string name = "100% \"odd\" ## \xC3\xA9 name.pdsm";
  copy("baked.pdsm", name);
  drop({name});
  EXPECT_EQ(faults(), 0U);
  EXPECT_EQ(session.library().maps()[0].path, path(name));
  std::filesystem::remove(path(name));
}

TEST_F(Drop, AMapWaitsForItsScene) {
  Session empty;
  empty.drop({path("key.pdsm")});
  EXPECT_EQ(empty.stage(), nullptr);
  empty.drop({path("nothing.scene.json")});
  EXPECT_EQ(empty.stage(), nullptr);
  empty.drop({path("plate.scene.json")});
  ASSERT_TRUE(empty.stage());
  EXPECT_EQ(empty.library().maps().size(), 1U);
}

}  // namespace
}  // namespace pdsm
