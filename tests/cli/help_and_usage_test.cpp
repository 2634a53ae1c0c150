// SPDX-License-Identifier: Apache-2.0
#include "scratch_scene.h"

namespace pdsm {
namespace {

const std::vector<std::string> kCommands{"bake",   "merge",  "info",   "check",  "query", "truth",
                                         "verify", "render", "export", "import", "diff"};

class Help : public ScratchScene {};
class Usage : public ScratchScene {};

TEST_F(Help, OfEveryCommandIsAResult) {
  for (const std::string& command : kCommands) {
    const Outcome outcome = run({command, "--help"});
    EXPECT_EQ(outcome.exit_code, 0) << command;
    EXPECT_EQ(outcome.err, "") << command;
    EXPECT_NE(outcome.out.find("Usage: pdsm " + command), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("Exit codes: 0 ok"), std::string::npos) << command;
  }
}

TEST_F(Help, ListsEveryCommand) {
  const Outcome outcome = run({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const std::string& command : kCommands)
    EXPECT_NE(outcome.out.find("\n  " + command + " "), std::string::npos);
}

TEST_F(Help, VersionIsAResult) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out.rfind("pdsm ", 0), 0U);
}

TEST_F(Help, FailsWhereItCanNotBeWritten) {
  for (const Stdout out : {Stdout::closed, Stdout::full, Stdout::broken_pipe}) {
    RunSetup setup;
    setup.out = out;
    const Outcome outcome = run({"bake", "--help"}, setup);
    expect_exit(outcome, 4);
    EXPECT_EQ(outcome.err.rfind("stdout: ", 0), 0U) << outcome.err;
  }
}

TEST_F(Usage, NeedsACommandThatThereIs) {
  expect_exit(run({}), 2);
  expect_exit(run({"frobnicate"}), 2);
  expect_exit(run({"--frobnicate"}), 2);
  expect_exit(run({""}), 2);
}

TEST_F(Usage, EveryCommandNeedsItsFiles) {
  for (const std::string& command : kCommands) expect_exit(run({command}), 2);
}

TEST_F(Usage, UnknownOptionsAreNamed) {
  for (const std::string& command : kCommands) {
    const Outcome outcome = run({command, "a", "b", "-o", "c.png", "--frobnicate"});
    expect_exit(outcome, 2);
    EXPECT_NE(outcome.err.find("--frobnicate"), std::string::npos) << command << ": " << outcome.err;
  }
}

/// Bakes with `option` `value` and expects "option: reason", and that nothing was made.
void expect_refused(const Outcome& outcome, const std::string& option, const std::string& value) {
  expect_exit(outcome, 2);
  EXPECT_EQ(outcome.err.rfind(option + ": ", 0), 0U) << value << " -> " << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

TEST_F(Usage, CountsAreStrict) {
  for (const std::string option : {"--samples", "--resolution", "--map-resolution"}) {
    for (const std::string value : {"0", "-1", "1e12", "1000000000000", "99999999999999999999", "4x", "4 ",
                                    " 4", "+4", "", "4.0", "nan", "0x10", "٤"}) {
      expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", option, value}), option, value);
    }
  }
  for (const std::string option : {"--seed", "--threads", "--tile"}) {
    for (const std::string value : {"-1", "1e12", "99999999999999999999", "4x", "", "nan"}) {
      expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", option, value}), option, value);
    }
  }
  for (const std::string value : {"7", "-1", "2x", "", "1e1", "0.5"}) {
    expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", "--mip-levels", value}), "--mip-levels",
                   value);
  }
  expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", "--tile", "65"}), "--tile", "65");
  expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", "--tile", "0"}), "--tile", "0");
  expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", "--threads", "1000000"}), "--threads", "");
  EXPECT_FALSE(exists("x.pdsm"));
}

TEST_F(Usage, RealsAreStrict) {
  for (const std::string option : {"--epsilon", "--depth-tolerance", "--bias"}) {
    for (const std::string value :
         {"-1", "-1e-9", "nan", "inf", "1e12", "0.1x", "", "0,1", "+0.1", "1e999"}) {
      expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", option, value}), option, value);
    }
  }
  for (const std::string value : {"1", "1.5"}) {
    expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", "--epsilon", value}), "--epsilon", value);
  }
  EXPECT_FALSE(exists("x.pdsm"));
}

TEST_F(Usage, SizesAndWordsAreStrict) {
  for (const std::string value : {"", "0", "-4G", "4Q", "G", "4GB", "nan", "inf", "1e30"}) {
    expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", "--memory", value}), "--memory", value);
  }
  for (const std::string value : {"5x", "x5", "5x0", "5x5x5", "5*5", "16385", "1x16385"}) {
    expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", "--resolution", value}), "--resolution",
                   value);
    expect_refused(run({"render", "a", "b", "-o", "x.png", "--size", value}), "--size", value);
  }
  for (const std::string option : {"--walk", "--receivers", "--points", "--isa"}) {
    for (const std::string value : {"", "nowhere", "EXACT", "exact ", "0"}) {
      expect_refused(run({"bake", "one.scene.json", "-o", "x.pdsm", option, value}), option, value);
    }
  }
  expect_refused(run({"query", "a", "--filter", "trilinear"}), "--filter", "trilinear");
  EXPECT_FALSE(exists("x.pdsm"));
}

TEST_F(Usage, OtherCommandsAreAsStrict) {
  for (const std::string value : {"0", "-1", "1e12", "4x", "nan", ""}) {
    expect_refused(run({"truth", "one.scene.json", "--samples", value}), "--samples", value);
    expect_refused(run({"verify", "a", "b", "--samples", value}), "--samples", value);
    expect_refused(run({"verify", "a", "b", "--points", value}), "--points", value);
    expect_refused(run({"render", "a", "b", "-o", "x.png", "--supersample", value}), "--supersample", value);
    expect_refused(run({"render", "a", "b", "-o", "x.png", "--truth-samples", value}), "--truth-samples",
                   value);
  }
  for (const std::string value : {"-1", "nan", "2", "0.1x", ""}) {
    expect_refused(run({"verify", "a", "b", "--max-error", value}), "--max-error", value);
    expect_refused(run({"diff", "a", "b", "--tolerance", value}), "--tolerance", value);
  }
  for (const std::string value : {"", "1,2,3", "1,2,3,4,5,6,7,8", "1,2,3,4,5,6,0", "1,2,3,4,5,6,180",
                                  "1,2,3,1,2,3,40", "1,2,3,4,5,nan,40", "1,2,3,4,5,6,40,"}) {
    expect_refused(run({"render", "a", "b", "-o", "x.png", "--camera", value}), "--camera", value);
  }
}

TEST_F(Usage, OptionsComeOnce) {
  expect_exit(run({"bake", "one.scene.json", "-o", "x.pdsm", "--samples", "4", "--samples", "5"}), 2);
  expect_exit(run({"bake", "one.scene.json", "-o", "x.pdsm", "--samples"}), 2);
}

}  // namespace
}  // namespace pdsm
