// SPDX-License-Identifier: Apache-2.0
// docs/scene.schema.json lists the keys that the reader knows.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "scene_folder.h"

namespace pdsm::test {
namespace {

using Keys = std::set<std::string>;

nlohmann::json schema() {
  std::ifstream file(PDSM_DOCS_DIR "/scene.schema.json");
  return nlohmann::json::parse(file);
}

void add_keys(Keys& keys, const nlohmann::json& properties) {
  for (const auto& [key, value] : properties.items()) keys.insert(key);
}

/// The keys that a refusal of an unknown key names.
Keys keys_told(const std::string& fault) {
  const std::string marker = "unknown key; known are ";
  const auto at = fault.find(marker);
  EXPECT_NE(at, std::string::npos) << fault;
  Keys keys;
  std::istringstream list(fault.substr(at + marker.size()));
  for (std::string key; std::getline(list >> std::ws, key, ',');) keys.insert(key);
  return keys;
}

TEST(Schema, ListsTheKeysOfTheScene) {
  const SceneFolder folder;
  Keys listed;
  add_keys(listed, schema()["properties"]);
  EXPECT_EQ(keys_told(folder.fault_of(R"({"?": 1})")), listed);
}

TEST(Schema, ListsTheKeysOfGeometry) {
  const SceneFolder folder;
  Keys listed;
  add_keys(listed, schema()["$defs"]["geometry"]["properties"]);
  EXPECT_EQ(keys_told(folder.fault_of(R"({"geometry": [{"?": 1}]})")), listed);
}

TEST(Schema, ListsTheKeysOfVolumes) {
  const SceneFolder folder;
  Keys listed;
  add_keys(listed, schema()["$defs"]["volume"]["properties"]);
  EXPECT_EQ(keys_told(folder.fault_of(R"({"volumes": [{"?": 1}]})")), listed);
}

TEST(Schema, ListsTheKeysOfCurves) {
  const SceneFolder folder;
  Keys listed;
  add_keys(listed, schema()["$defs"]["curves"]["properties"]);
  EXPECT_EQ(keys_told(folder.fault_of(R"({"curves": [{"?": 1}]})")), listed);
}

TEST(Schema, ListsTheKeysOfPartRules) {
  const SceneFolder folder;
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  Keys listed;
  add_keys(listed, schema()["$defs"]["part"]["properties"]);
  EXPECT_EQ(keys_told(folder.fault_of(scene_of("a.obj", R"("parts": [{"?": 1}])"))), listed);
}

TEST(Schema, ListsTheKeysOfLights) {
  const SceneFolder folder;
  const nlohmann::json light = schema()["$defs"]["light"];
  ASSERT_EQ(light["oneOf"].size(), 5U);
  for (const nlohmann::json& kind : light["oneOf"]) {
    const std::string type = kind["properties"]["type"]["const"];
    Keys listed;
    add_keys(listed, light["properties"]);
    add_keys(listed, kind["properties"]);
    Keys known = keys_told(folder.fault_of(R"({"lights": [{"type": ")" + type + R"(", "?": 1}]})"));
    // What all kinds have but those that shine to all sides.
    if (type == "sphere" || type == "mesh") {
      EXPECT_EQ(listed.erase("window"), 1U);
    }
    EXPECT_EQ(known, listed) << type;
  }
}

}  // namespace
}  // namespace pdsm::test
