// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/journal.h"

#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "pdsm/format/error.h"
#include "small_sweep.h"

namespace pdsm {
namespace {

using JournalFile = SweepFolder;
const nlohmann::ordered_json kIdentity{{"input_hash", "1"}};

TEST_F(JournalFile, GivesBackWhatWasAppended) {
  {
    Journal journal(path("j"), kIdentity);
    EXPECT_EQ(journal.earlier(), 0U);
    for (const std::uint32_t samples : {4U, 16U, 64U}) journal.append(example_measurement(samples));
    EXPECT_EQ(journal.measurements().size(), 3U);
  }
  const std::string before = contents("j");
  const Journal journal(path("j"), kIdentity);
  EXPECT_EQ(journal.earlier(), 3U);
  ASSERT_NE(journal.find(example_measurement(16).setting), nullptr);
  EXPECT_EQ(journal.find(example_measurement(17).setting), nullptr);
  // Every field, bit for bit.
  EXPECT_EQ(to_json(*journal.find(example_measurement(16).setting)), to_json(example_measurement(16)));
  EXPECT_EQ(to_json(measurement_of(to_json(example_measurement(5)))), to_json(example_measurement(5)));
  EXPECT_EQ(contents("j"), before);
}

// Cut anywhere, a journal gives back the lines that are whole, and takes new ones.
TEST_F(JournalFile, DropsALineThatWasCutOff) {
  {
    Journal journal(path("j"), kIdentity);
    journal.append(example_measurement(4));
    journal.append(example_measurement(16));
  }
  const std::string whole = contents("j");
  const std::size_t header = whole.find('\n') + 1, first = whole.find('\n', header) + 1;
  std::vector<std::size_t> sizes{0, header - 1, header, first - 1, first, whole.size() - 1, whole.size()};
  for (std::size_t size = 7; size < whole.size(); size += 29) sizes.push_back(size);
  for (const std::size_t size : sizes) {
    write_file("j", whole.substr(0, size));
    const std::size_t kept = size == whole.size() ? 2 : size >= first ? 1 : 0;
    {
      Journal journal(path("j"), kIdentity);
      ASSERT_EQ(journal.earlier(), kept) << size;
      journal.append(example_measurement(64));
    }
    ASSERT_EQ(Journal(path("j"), kIdentity).earlier(), kept + 1) << size;
  }
}

TEST_F(JournalFile, VoidsWhatFollowsDamage) {
  {
    Journal journal(path("j"), kIdentity);
    for (const std::uint32_t samples : {4U, 16U, 64U}) journal.append(example_measurement(samples));
  }
  std::string text = contents("j");
  const std::size_t second = text.find("\"samples\":16");
  text[second] = ' ';
  write_file("j", text);
  EXPECT_EQ(Journal(path("j"), kIdentity).earlier(), 1U);
}

TEST_F(JournalFile, StartsAnewForAnotherScene) {
  {
    Journal journal(path("j"), kIdentity);
    journal.append(example_measurement(4));
  }
  {
    const Journal journal(path("j"), {{"input_hash", "2"}});
    EXPECT_EQ(journal.earlier(), 0U);
  }
  EXPECT_EQ(Journal(path("j"), kIdentity).earlier(), 0U) << "what was of the first scene is gone";
}

TEST_F(JournalFile, FailsWhereItCantBeWritten) {
  const auto failure_of = [](const std::filesystem::path& path) {
    try {
      const Journal journal(path, kIdentity);
    } catch (const Error& error) {
      return error.failure();
    }
    return Failure::usage;
  };
  EXPECT_EQ(failure_of(path("missing") / "j"), Failure::resource);
  EXPECT_EQ(failure_of(path()), Failure::resource);
}

}  // namespace
}  // namespace pdsm
