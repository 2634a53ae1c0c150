// SPDX-License-Identifier: Apache-2.0
#include "pdsm/bake/manifest.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "pdsm/format/error.h"

namespace pdsm {
namespace {

namespace fs = std::filesystem;

class ManifestFile : public testing::Test {
 protected:
  ManifestFile() {
    std::string name = (fs::temp_directory_path() / "pdsm_manifest_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
    folder_ = name;
  }
  ~ManifestFile() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  [[nodiscard]] fs::path path() const { return folder_ / kManifestName; }
  [[nodiscard]] std::string contents() const {
    std::ifstream file(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// Which file it is: another one after each writing.
  [[nodiscard]] ino_t inode() const {
    struct stat status {};
    return stat(path().c_str(), &status) == 0 ? status.st_ino : 0;
  }

 private:
  fs::path folder_;
};

ManifestLight baked_light() {
  ManifestLight entry;
  entry.light.name = "key";
  entry.light.shape = RectLight{2, 1};
  entry.file = "key.pdsm";
  entry.bytes = 1234;
  entry.key = std::string(32, 'a');
  entry.view = View{};
  return entry;
}

TEST_F(ManifestFile, IsNotTouchedWhileItHoldsTheSame) {
  write_manifest({baked_light()}, path());
  const ino_t first = inode();
  // Kept open, so that no other file can take its number.
  const std::ifstream open(path());
  write_manifest({baked_light()}, path());
  EXPECT_EQ(inode(), first);
  ManifestLight other = baked_light();
  other.bytes = 1235;
  write_manifest({other}, path());
  EXPECT_NE(inode(), first);
  EXPECT_EQ(contents(), manifest_text({other}));
}

TEST_F(ManifestFile, DamageOfTheSameLengthIsMended) {
  write_manifest({baked_light()}, path());
  std::ofstream(path(), std::ios::binary) << std::string(manifest_text({baked_light()}).size(), '?');
  write_manifest({baked_light()}, path());
  EXPECT_EQ(contents(), manifest_text({baked_light()}));
}

TEST_F(ManifestFile, ThatCanNotBeWrittenFails) {
  try {
    write_manifest({}, path() / "missing" / "manifest.json");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::resource);
  }
}

TEST(Manifest, NamesNoFileOfALightWithoutMap) {
  ManifestLight entry = baked_light();
  entry.status = MapStatus::skipped;
  entry.reason = "no reason";
  const auto json = nlohmann::json::parse(manifest_text({entry}));
  const auto& light = json["lights"].at(0);
  EXPECT_EQ(light["status"], "skipped");
  EXPECT_EQ(light["reason"], "no reason");
  for (const char* key : {"file", "bytes", "key", "view", "error"}) EXPECT_FALSE(light.contains(key)) << key;
}

}  // namespace
}  // namespace pdsm
