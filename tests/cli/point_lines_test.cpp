// SPDX-License-Identifier: Apache-2.0
// The line protocol of `query` and `truth`.
#include <signal.h>

#include <algorithm>

#include "pdsm/format/map_file.h"
#include "scratch_scene.h"

namespace pdsm {
namespace {

class PointLines : public ScratchScene {
 protected:
  PointLines() { bake_small("map.pdsm"); }

  /// Both commands that speak the protocol.
  const std::vector<std::vector<std::string>> kCommands{{"query", "map.pdsm"},
                                                        {"truth", "one.scene.json", "--samples", "64"}};

  [[nodiscard]] Outcome say(const std::vector<std::string>& command, const std::string& input,
                            Stdout out = Stdout::pipe) const {
    RunSetup setup;
    setup.input = input;
    setup.out = out;
    return run(command, setup);
  }
};

TEST_F(PointLines, OneLineInOneLineOut) {
  // Under the plate, beside its shadow, behind the light.
  for (const auto& command : kCommands) {
    const Outcome outcome = say(command, "0 0.1 0\n3.5 0.1 0\n0 5 0\n");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "1\n0\n0\n") << command[0];
    EXPECT_EQ(outcome.err, "");
  }
}

TEST_F(PointLines, BlanksTabsCarriageReturnsAndNoLastLineEnd) {
  for (const auto& command : kCommands) {
    const Outcome outcome = say(command, " 0\t0.1  0 \r\n3.5 1e-1 -0\r\n0 5 0");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "1\n0\n0\n") << command[0];
  }
}

TEST_F(PointLines, EmptyInputIsFine) {
  for (const auto& command : kCommands) {
    const Outcome outcome = say(command, "");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
  }
}

TEST_F(PointLines, BadLinesAreNumberedAndThoseBeforeAnswered) {
  const std::vector<std::string> bad{"",        " ",      "1 2",     "1 2 3 4", "1 2 x",
                                     "1,5 2 3", "1;2;3",  "nan 0 0", "inf 0 0", "1e999 0 0",
                                     "0x1 0 0", "1 2 3x", "+1 2 3",  "# 1 2 3", std::string(5000, '1')};
  for (const auto& command : kCommands) {
    for (const std::string& line : bad) {
      const Outcome outcome = say(command, "0 0.1 0\n0 5 0\n" + line + "\n0 0.1 0\n");
      expect_exit(outcome, 3);
      EXPECT_EQ(outcome.out, "1\n0\n") << command[0] << " '" << line << "'";
      EXPECT_EQ(outcome.err.rfind("stdin:3: ", 0), 0U) << "'" << line << "' -> " << outcome.err;
    }
  }
}

TEST_F(PointLines, EndlessLineIsRefused) {
  for (const auto& command : kCommands) {
    const Outcome outcome = say(command, "0 0.1 0\n" + std::string(1000000, '7'));
    expect_exit(outcome, 3);
    EXPECT_EQ(outcome.err, "stdin:2: the line is too long\n");
  }
}

TEST_F(PointLines, LinesMayBeSplitAnywhere) {
  // Long enough for many reads: a line must not break where a read ends.
  std::string input, expected;
  for (int i = 0; i < 20000; ++i) {
    const bool dark = i % 3 == 0;
    input += dark ? "0.0 0.100 0\n" : "3.5 0.1 0\n";
    expected += dark ? "1\n" : "0\n";
  }
  const Outcome outcome = say(kCommands[0], input);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(outcome.out == expected);
}

TEST_F(PointLines, ClosedOutputIsAFault) {
  for (const auto& command : kCommands) {
    for (const Stdout out : {Stdout::closed, Stdout::full, Stdout::broken_pipe}) {
      const Outcome outcome = say(command, "0 0.1 0\n", out);
      expect_exit(outcome, 4);
      EXPECT_EQ(outcome.err.rfind("stdout: ", 0), 0U) << outcome.err;
    }
  }
}

TEST_F(PointLines, AnswersBeforeMoreIsAsked) {
  for (const auto& command : kCommands) {
    RunningPdsm talk(command, path(""));
    talk.say("0 0.1 0\n");
    EXPECT_EQ(talk.hear_line(), "1");
    talk.say("0 5 0\n0 0.1 0\n");
    EXPECT_EQ(talk.hear_line(), "0");
    EXPECT_EQ(talk.hear_line(), "1");
  }
}

TEST_F(PointLines, InterruptEndsWith130) {
  for (const auto& command : kCommands) {
    RunningPdsm talk(command, path(""));
    talk.say("0 0.1 0\n");
    EXPECT_EQ(talk.hear_line(), "1");
    talk.send(SIGINT);
    EXPECT_EQ(talk.wait(), 130) << command[0];
  }
}

TEST_F(PointLines, QueryTellsStatus) {
  const Outcome outcome =
      say({"query", "map.pdsm", "--status"}, "0 0.1 0\n0 5 0\n0 3.99 0\n0 -3 0\n100 0 0\n");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "1 inside\n0 behind\n0 outside\n1 past-end\n0 outside\n");
}

TEST_F(PointLines, QueryTellsThreeChannels) {
  // Red as baked, green lit everywhere, blue as red.
  PenumbraMap map = read_map(path("map.pdsm"));
  ASSERT_EQ(map.images.size(), 1U);
  map.channels = 3;
  map.block_keys.clear();
  for (const std::uint32_t channel : {1U, 2U}) {
    FunctionImage image = map.images[0];
    image.channel = channel;
    for (FunctionBlock& block : image.blocks) {
      if (channel == 2) continue;
      std::fill(block.first.begin(), block.first.end(), 0U);
      block.words.clear();
    }
    map.images.push_back(std::move(image));
  }
  write_map(map, path("colour.pdsm"));
  const Outcome outcome = say({"query", "colour.pdsm", "--status"}, "0 0.1 0\n100 0 0\n");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "1 0 1 inside\n0 0 0 outside\n");
}

TEST_F(PointLines, QueryFilters) {
  // At the border of the shadow the four texels differ; nearest takes one of them.
  std::string input;
  for (int i = 0; i < 40; ++i) input += std::to_string(1.0 + 0.017 * i) + " 0.05 0.4\n";
  const Outcome nearest = say({"query", "map.pdsm", "--filter", "nearest"}, input);
  const Outcome bilinear = say({"query", "map.pdsm", "--filter", "bilinear"}, input);
  const Outcome standard = say({"query", "map.pdsm"}, input);
  EXPECT_EQ(nearest.exit_code, 0);
  EXPECT_EQ(std::count(nearest.out.begin(), nearest.out.end(), '\n'), 40);
  EXPECT_NE(nearest.out, bilinear.out);
  EXPECT_EQ(standard.out, bilinear.out);
}

TEST_F(PointLines, TruthAnswersAPointAlwaysTheSame) {
  const std::string point = "1.3 0.05 0.4\n";
  const Outcome outcome = say(kCommands[1], point + point + point);
  ASSERT_EQ(outcome.exit_code, 0);
  const std::string first = outcome.out.substr(0, outcome.out.find('\n') + 1);
  EXPECT_EQ(outcome.out, first + first + first);
  EXPECT_NE(first, "0\n");
  EXPECT_NE(first, "1\n");
}

TEST_F(PointLines, TruthNeedsALightWhereThereAreSeveral) {
  const Outcome unnamed = say({"truth", "two.scene.json"}, "0 0.1 0\n");
  expect_exit(unnamed, 2);
  EXPECT_EQ(unnamed.err.rfind("--light: ", 0), 0U) << unnamed.err;
  expect_exit(say({"truth", "two.scene.json", "--light", "sun"}, "0 0.1 0\n"), 2);
  const Outcome named = say({"truth", "two.scene.json", "--light", "lamp"}, "0 0.1 0\n");
  EXPECT_EQ(named.exit_code, 0);
  EXPECT_EQ(named.out, "1\n");
}

TEST_F(PointLines, BadFilesAreBadInput) {
  expect_exit(say({"query", "missing.pdsm"}, ""), 3);
  expect_exit(say({"query", "plate.obj"}, ""), 3);
  expect_exit(say({"query", "."}, ""), 3);
  expect_exit(say({"truth", "missing.json"}, ""), 3);
  expect_exit(say({"truth", "plate.obj"}, ""), 3);
}

}  // namespace
}  // namespace pdsm
