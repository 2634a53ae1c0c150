// SPDX-License-Identifier: Apache-2.0
#include "pdsm/format/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <optional>
#include <string>

#include "file_size_limit.h"
#include "pdsm/format/error.h"
#include "pdsm/format/map_file.h"
#include "random_map.h"
#include "scratch_folder.h"

namespace pdsm {
namespace {

using testing::file_content;
using testing::FileSizeLimit;
using testing::ScratchFolder;

std::vector<std::byte> text(const std::string& content) {
  const auto bytes = std::as_bytes(std::span(content));
  return {bytes.begin(), bytes.end()};
}

/// `action` throws a resource error that begins with `path`.
template <typename Action>
void expect_resource_error(const std::filesystem::path& path, Action action) {
  try {
    action();
    ADD_FAILURE() << "no error for " << path;
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::resource);
    EXPECT_EQ(std::string(error.what()).substr(0, path.string().size() + 2), path.string() + ": ");
  }
}

TEST(AtomicFile, AppearsAtCommitOnly) {
  const ScratchFolder folder;
  const auto path = folder.path() / "map";
  AtomicFile file(path);
  file.write(text("new "));
  file.write(text("content"));
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(file.temporary().parent_path(), folder.path());
  file.commit();
  EXPECT_EQ(file_content(path), text("new content"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"map"});
}

TEST(AtomicFile, WithoutCommitTheOldFileStays) {
  const ScratchFolder folder;
  const auto path = folder.path() / "map";
  testing::put_file(path, text("old"));
  {
    AtomicFile file(path);
    file.write(text("new"));
    EXPECT_EQ(folder.names().size(), 2U);
  }
  EXPECT_EQ(file_content(path), text("old"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"map"});
}

TEST(AtomicFile, ReplacesTheOldFile) {
  const ScratchFolder folder;
  const auto path = folder.path() / "map";
  testing::put_file(path, text("a much longer old content"));
  AtomicFile file(path);
  file.write(text("new"));
  file.commit();
  EXPECT_EQ(file_content(path), text("new"));
}

TEST(AtomicFile, TwoWritersOneWholeWinner) {
  const ScratchFolder folder;
  const auto path = folder.path() / "map";
  AtomicFile first(path), second(path);
  first.write(text("first"));
  second.write(text("second"));
  second.commit();
  first.commit();
  EXPECT_EQ(file_content(path), text("first"));
  EXPECT_EQ(folder.names().size(), 1U);
}

TEST(AtomicFile, FollowsALinkAndKeepsIt) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path() / "elsewhere");
  testing::put_file(folder.path() / "elsewhere" / "map", text("old"));
  std::filesystem::create_symlink("elsewhere/map", folder.path() / "link");
  AtomicFile file(folder.path() / "link");
  file.write(text("new"));
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_EQ(file_content(folder.path() / "elsewhere" / "map"), text("new"));
}

TEST(AtomicFile, SurvivesAChangeOfTheWorkingFolder) {
  const ScratchFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  {
    AtomicFile file("map");
    std::filesystem::current_path(before);
    file.write(text("new"));
    file.commit();
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"map"});
}

TEST(AtomicFile, LongestNames) {
  const ScratchFolder folder;
  const auto path = folder.path() / std::string(255, 'n');
  AtomicFile file(path);
  file.commit();
  EXPECT_TRUE(std::filesystem::exists(path));
}

TEST(AtomicFile, RefusesAtOnceWhatItCannotReplace) {
  const ScratchFolder folder;
  const auto plain = folder.path() / "plain", pipe = folder.path() / "pipe";
  testing::put_file(plain, text("old"));
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::filesystem::path& path : {folder.path(), plain / "map", folder.path() / "missing" / "map",
                                            pipe, std::filesystem::path("/dev/full"), folder.path() / ""}) {
    expect_resource_error(path, [&] { AtomicFile file(path); });
  }
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"pipe", "plain"}));
}

TEST(AtomicFile, FullDiskLeavesTheOldFileAndNothingElse) {
  const ScratchFolder folder;
  const auto path = folder.path() / "map";
  testing::put_file(path, text("old"));
  {
    const FileSizeLimit limit(1000);
    AtomicFile file(path);
    file.write(std::vector<std::byte>(600));
    expect_resource_error(path, [&] { file.write(std::vector<std::byte>(600)); });
  }
  EXPECT_EQ(file_content(path), text("old"));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"map"});
}

TEST(AtomicFile, MapThatDoesNotFitLeavesTheOldFile) {
  const ScratchFolder folder;
  const auto path = folder.path() / "map";
  testing::put_file(path, text("old"));
  const PenumbraMap map = testing::random_map(1);
  const std::size_t size = serialize_map(map).size();
  for (std::size_t room = 0; room < size; room += size / 7) {
    std::optional<FileSizeLimit> limit(room);
    expect_resource_error(path, [&] { write_map(map, path); });
    limit.reset();
    EXPECT_EQ(file_content(path), text("old"));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"map"});
  }
}

TEST(AtomicFile, RemovesTemporariesForASignalHandler) {
  const ScratchFolder folder;
  AtomicFile first(folder.path() / "a");
  std::optional<AtomicFile> second(folder.path() / "b");
  second->commit();
  AtomicFile third(folder.path() / "c");
  EXPECT_EQ(folder.names().size(), 3U);
  AtomicFile::remove_temporaries();
  EXPECT_EQ(folder.names(), std::vector<std::string>{"b"});
  expect_resource_error(folder.path() / "a", [&] { first.commit(); });
  EXPECT_EQ(folder.names(), std::vector<std::string>{"b"});
}

TEST(AtomicFile, ASignalHandlerMayRemoveAndExit) {
  const ScratchFolder folder;
  const auto interrupted = [&] {
    std::signal(SIGINT, [](int) {
      AtomicFile::remove_temporaries();
      std::_Exit(130);
    });
    AtomicFile file(folder.path() / "map");
    file.write(text("half"));
    std::raise(SIGINT);
  };
  EXPECT_EXIT(interrupted(), ::testing::ExitedWithCode(130), "");
  EXPECT_TRUE(folder.names().empty());
}

TEST(AtomicFile, MoreWritersThanSlots) {
  const ScratchFolder folder;
  std::vector<std::unique_ptr<AtomicFile>> files;
  for (int n = 0; n < 100; ++n)
    files.push_back(std::make_unique<AtomicFile>(folder.path() / std::to_string(n)));
  for (auto& file : files) file->commit();
  EXPECT_EQ(folder.names().size(), 100U);
}

}  // namespace
}  // namespace pdsm
