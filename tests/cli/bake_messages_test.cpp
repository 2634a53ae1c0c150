// SPDX-License-Identifier: Apache-2.0
// What `pdsm bake` says while it works, for programs.
#include <nlohmann/json.hpp>
#include <sstream>

#include "scratch_scene.h"

namespace pdsm {
namespace {

using Json = nlohmann::json;

class BakeMessages : public ScratchScene {
 protected:
  /// The JSON objects on stderr; every other line is added to `others`.
  static std::vector<Json> objects(const std::string& err, std::string& others) {
    std::vector<Json> result;
    std::istringstream stream(err);
    for (std::string line; std::getline(stream, line);) {
      if (line.starts_with("{"))
        result.push_back(Json::parse(line));
      else
        others += line + "\n";
    }
    return result;
  }
};

TEST_F(BakeMessages, ProgressIsOneObjectALine) {
  const std::vector<std::string> arguments{"bake",    "two.scene.json", "-o",   "maps",
                                           "--quiet", "--progress",     "json", "--samples",
                                           "16",      "--resolution",   "32"};
  for (const std::string status : {"baked", "unchanged"}) {
    const Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::string others;
    const std::vector<Json> told = objects(outcome.err, others);
    EXPECT_EQ(others, "");
    std::vector<std::string> ended;
    for (const Json& object : told) {
      EXPECT_TRUE(object["light"].is_string() && object["step"].is_string()) << object;
      EXPECT_GE(object["done"], 0) << object;
      EXPECT_LE(object["done"], 1) << object;
      for (const char* key : {"rays_per_second", "seconds_left"}) {
        ASSERT_TRUE(object.contains(key)) << object;
        EXPECT_TRUE(object[key].is_null() || object[key] >= 0) << object;
      }
      if (object["step"] == status) ended.push_back(object["light"]);
    }
    EXPECT_EQ(ended, (std::vector<std::string>{"key", "lamp"}));
    // Each bake tells of its beginning.
    EXPECT_GE(told.size(), status == "baked" ? 4U : 2U);
  }
}

TEST_F(BakeMessages, TrialsTellTheirPurpose) {
  const Outcome outcome = run({"bake", "one.scene.json", "-o", "x.pdsm", "--target-error", "0.2", "--samples",
                               "16", "--map-resolution", "32", "--quiet", "--progress", "json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::string others;
  bool any = false;
  for (const Json& object : objects(outcome.err, others)) any = any || object.contains("trial");
  EXPECT_TRUE(any) << outcome.err;
}

TEST_F(BakeMessages, ThereIsNoneByDefault) {
  const Outcome outcome =
      run({"bake", "one.scene.json", "-o", "x.pdsm", "--samples", "4", "--resolution", "8"});
  std::string others;
  EXPECT_TRUE(objects(outcome.err, others).empty()) << outcome.err;
  expect_exit(run({"bake", "one.scene.json", "-o", "x.pdsm", "--progress", "loud"}), 2);
}

TEST_F(BakeMessages, WarningsMayBeErrors) {
  write_file("plate.obj", contents("plate.obj") + "v 0 0 0\nf 1 1 5\n");
  const std::vector<std::string> arguments{"bake", "one.scene.json", "-o", "x.pdsm", "--samples",
                                           "4",    "--resolution",   "8"};
  const Outcome warned = run(arguments);
  EXPECT_EQ(warned.exit_code, 0);
  EXPECT_EQ(warned.err.rfind("warning: plate.obj: 1 triangle without area left out", 0), 0U) << warned.err;
  std::vector<std::string> strict = arguments;
  strict.push_back("--warnings-as-errors");
  strict[3] = "y.pdsm";
  const Outcome refused = run(strict);
  expect_exit(refused, 3);
  EXPECT_EQ(refused.err.rfind("plate.obj: 1 triangle without area left out", 0), 0U) << refused.err;
  EXPECT_FALSE(exists("y.pdsm"));
}

}  // namespace
}  // namespace pdsm
