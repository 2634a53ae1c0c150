// SPDX-License-Identifier: Apache-2.0
// Numbers are read alike under locales that write 1,5.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <clocale>
#include <cstdio>
#include <locale>

#include "scene_folder.h"

namespace pdsm::test {
namespace {

const char* const kObj = "v 0.5 0 0\nv 1.25 0 0\nv 0 1.5 0\nf 1 2 3\n";

void expect_fractions_are_read() {
  const SceneFolder folder;
  folder.write("a.obj", kObj);
  const Scene scene = folder.read(scene_of("a.obj", R"("scale": 2.5, "translate": [0.75, 1e-3, 0])"));
  const Geometry& geometry = scene.geometry.at(0);
  EXPECT_EQ(geometry.local_to_world[0][0], 2.5);
  EXPECT_EQ(glm::dvec3(geometry.local_to_world[3]), glm::dvec3(0.75, 1e-3, 0));
  EXPECT_EQ(geometry.mesh->positions.at(1).x, 1.25F);
  EXPECT_EQ(folder.fault_of(scene_with_light(R"("fov": 120.5)")).find("1e+12"), std::string::npos);
  EXPECT_EQ(folder.fault_of(scene_with_light(R"("near": 2.5, "far": 2.25)")),
            "level.scene.json:lights[0].near: must be less than far");
}

/// Decimal commas and grouping for C++ streams.
class CommaNumbers : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\1"; }
};

TEST(Locale, CommaDecimalsOfStreams) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
  expect_fractions_are_read();
  std::locale::global(before);
}

TEST(Locale, CommaDecimalsOfC) {
  // The locale is made here: hardly any system that builds has one.
  const SceneFolder folder;
  const std::string target = (folder.path() / "de_DE.UTF-8").string();
  const std::string command = "localedef -i de_DE -f UTF-8 '" + target + "' >/dev/null 2>&1";
  const bool made = std::system(command.c_str()) == 0;
  setenv("LOCPATH", folder.path().c_str(), 1);
  const bool set = made && std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
  if (set) {
    char text[8];
    std::snprintf(text, sizeof(text), "%.1f", 1.5);
    EXPECT_STREQ(text, "1,5");
    expect_fractions_are_read();
  }
  std::setlocale(LC_ALL, "C");
  unsetenv("LOCPATH");
  if (!set) GTEST_SKIP() << "localedef cannot make de_DE.UTF-8 here";
}

}  // namespace
}  // namespace pdsm::test
