// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/output_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <ostream>
#include <utility>

#include "error_sentence.hpp"
#include "io/file_mark.hpp"
#include "occusg/error.hpp"
#include "temporary_folder.hpp"

namespace occusg {
namespace {

using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;

std::size_t filesIn(const std::string& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

/// Makes the file system refuse files beyond a size, as a full disk does.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit{bytes, old_limit_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_limit_{};
  void (*old_handler_)(int) = nullptr;
};

/// Root may write anywhere: for its lifetime, a process of root's acts as the user nobody.
class AsOrdinaryUser {
 public:
  AsOrdinaryUser() : is_root_(::geteuid() == 0) {
    constexpr uid_t kNobody = 65534;
    if (!is_root_) return;
    EXPECT_EQ(::seteuid(kNobody), 0);
  }
  AsOrdinaryUser(const AsOrdinaryUser&) = delete;
  AsOrdinaryUser& operator=(const AsOrdinaryUser&) = delete;
  ~AsOrdinaryUser() {
    if (!is_root_) return;
    EXPECT_EQ(::seteuid(0), 0);
  }

 private:
  bool is_root_;
};

TEST(OutputFolder, CreatesTheFolderAndItsParentsAndLeavesThemEmpty) {
  const TemporaryFolder folder;
  const OutputFolder output(folder.at("a/b/c"));
  EXPECT_EQ(output.path(), folder.at("a/b/c"));
  EXPECT_EQ(filesIn(folder.at("a/b/c")), 0U);
}

TEST(OutputFolder, WritesAndReplacesFilesAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const OutputFolder output(folder.path());
  const std::string bytes("a\0b\n", 4);
  output.write("x.bin", "old");
  output.write("x.bin", bytes);
  output.write("empty", "");
  EXPECT_EQ(folder.read("x.bin"), bytes);
  EXPECT_EQ(folder.read("empty"), "");
  EXPECT_EQ(filesIn(folder.path()), 2U);
}

TEST(OutputFolder, StreamedFileIsThatOfTheSameBytesAndIsMarked) {
  const TemporaryFolder folder;
  const OutputFolder output(folder.path());
  std::string bytes;
  for (int i = 0; i < 50'000; ++i) bytes += std::to_string(i) + '\n';  // several buffers
  const FileMark mark = output.write("x", [](std::ostream& out) {
    for (int i = 0; i < 50'000; ++i) out << i << '\n';
  });
  EXPECT_TRUE(folder.read("x") == bytes);
  EXPECT_TRUE(mark == markOf(bytes));
}

TEST(OutputFolder, StreamedFileThatNoReaderWouldTakeOrWhoseWriterFailsKeepsThePrevious) {
  const TemporaryFolder folder;
  const OutputFolder output(folder.path());
  output.write("x", "previous");
  const auto large = [](std::ostream& out) { out << std::string(1'000'000, 'n'); };
  EXPECT_TRUE(tells(sentenceOf([&] { output.write("x", large, 999'999); }),
                    {folder.at("x"), "would be larger than 999999 bytes"}));
  const auto failing = [](std::ostream& out) {
    out << "half";
    throw Error("no more");
  };
  EXPECT_TRUE(tells(sentenceOf([&] { output.write("x", failing); }), {"no more"}));
  EXPECT_EQ(folder.read("x"), "previous");
  EXPECT_EQ(filesIn(folder.path()), 1U);
  EXPECT_NO_THROW(output.write("x", large, 1'000'000));
}

TEST(OutputFolder, FailureMode16FullDiskStopsAStreamedFileToo) {
  const TemporaryFolder folder;
  const OutputFolder output(folder.path());
  output.write("x", "previous");
  const FileSizeLimit limit(100'000);
  const auto large = [](std::ostream& out) { out << std::string(1'000'000, 'n'); };
  EXPECT_TRUE(tells(sentenceOf([&] { output.write("x", large); }),
                    {folder.at("x"), "cannot be written", "space left"}));
  EXPECT_EQ(folder.read("x"), "previous");
}

TEST(OutputFolder, FailureMode16FullDiskKeepsThePreviousFileAndLeavesNoOther) {
  const TemporaryFolder folder;
  const OutputFolder output(folder.path());
  output.write("x.json", "previous");
  std::string sentence;
  {
    const FileSizeLimit limit(1000);
    sentence = sentenceOf([&] { output.write("x.json", std::string(5000, 'n')); });
  }
  EXPECT_TRUE(tells(sentence, {folder.at("x.json"), "cannot be written", "space left"}));
  EXPECT_EQ(folder.read("x.json"), "previous");
  EXPECT_EQ(filesIn(folder.path()), 1U);
}

TEST(OutputFolder, FullDiskIsFoundOnOpening) {
  const TemporaryFolder folder;
  const FileSizeLimit limit(0);
  EXPECT_TRUE(tells(sentenceOf([&] { OutputFolder output(folder.path()); }),
                    {folder.path(), "cannot be written", "space left"}));
}

TEST(OutputFolder, LeftoverOfAKilledRunIsNoObstacle) {
  const TemporaryFolder folder;
  folder.write(".x.json." + std::to_string(::getpid()) + ".part", "half");
  OutputFolder(folder.path()).write("x.json", "whole");
  EXPECT_EQ(folder.read("x.json"), "whole");
  EXPECT_EQ(filesIn(folder.path()), 1U);
}

/// A number that was a process's and is none any more.
std::string endedProcess() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  int status = 0;
  ::waitpid(child, &status, 0);
  return std::to_string(child);
}

TEST(OutputFolder, FailureMode14PartsOfKilledWritersGoWhenTheFolderIsOpened) {
  const TemporaryFolder folder;
  const std::string ended = endedProcess();
  folder.write(".rooms.json." + ended + ".part", "half");
  folder.write(".session." + ended + ".part/map.ot", "half");
  folder.write(".session." + ended + ".part/.session.json." + ended + ".part", "half");
  const OutputFolder output(folder.path());
  EXPECT_EQ(filesIn(folder.path()), 0U);
}

TEST(OutputFolder, PartsOfThoseWhoStillWriteAndFilesOfOthersStay) {
  const TemporaryFolder folder;
  const std::string ended = endedProcess();
  folder.write(".held.json." + ended + ".part", "being written in another container");
  const int held = ::open(folder.at(".held.json." + ended + ".part").c_str(), O_RDONLY);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  folder.write(".x.json." + std::to_string(::getppid()) + ".part", "of a running process");
  folder.write(".film." + ended + ".part/season 1/film", "another program's");
  folder.write("film.part", "x");
  folder.write(".film.part", "x");
  folder.write(".film.1a.part", "x");
  folder.write("." + ended + ".part", "x");
  const OutputFolder output(folder.path());
  EXPECT_EQ(filesIn(folder.path()), 7U);
  ::close(held);
}

TEST(OutputFolder, FileInPlaceOfTheFolderIsRefused) {
  const TemporaryFolder folder;
  folder.write("taken", "x");
  EXPECT_TRUE(tells(sentenceOf([&] { OutputFolder output(folder.at("taken")); }),
                    {folder.at("taken") + ": is a file", "a folder is needed"}));
  EXPECT_TRUE(tells(sentenceOf([&] { OutputFolder output(folder.at("taken/out")); }),
                    {folder.at("taken/out"), "cannot be created"}));
  EXPECT_TRUE(tells(sentenceOf([&] { OutputFolder output(""); }), {"cannot be created"}));
}

TEST(OutputFolder, FolderThatCannotBeWrittenIsFoundOnOpening) {
  EXPECT_TRUE(tells(sentenceOf([&] { OutputFolder output("/proc/self"); }),
                    {"/proc/self", "cannot be written"}));
}

TEST(OutputFolder, FailureMode16ReadOnlyFolderIsFoundOnOpening) {
  const TemporaryFolder folder;
  std::filesystem::permissions(
      folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec |
                         std::filesystem::perms::others_read | std::filesystem::perms::others_exec);
  std::optional<AsOrdinaryUser> ordinary_user(std::in_place);
  EXPECT_TRUE(tells(sentenceOf([&] { OutputFolder output(folder.path()); }),
                    {folder.path(), "Permission denied"}));
  ordinary_user.reset();
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(OutputFolder, LinkToAFolderIsAFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.at("results"));
  std::filesystem::create_directory_symlink(folder.at("results"), folder.at("link"));
  OutputFolder(folder.at("link")).write("a.txt", "a");
  EXPECT_EQ(folder.read("results/a.txt"), "a");
}

TEST(OutputFolder, OnlyPlainNamesAreWritten) {
  const TemporaryFolder folder;
  const OutputFolder output(folder.path());
  for (const std::string& name :
       {std::string(), std::string("."), std::string(".."), std::string("../x"), std::string("/x"),
        std::string("a/b"), std::string("a\0b", 3), std::string(201, 'n')})
    EXPECT_TRUE(
        tells(sentenceOf([&] { output.write(name, "x"); }), {folder.path(), "is not a file name"}));
  EXPECT_EQ(filesIn(folder.path()), 0U);
}

TEST(OutputFolder, FolderInPlaceOfTheFileIsRefusedAndKept) {
  const TemporaryFolder folder;
  folder.write("x.json/inside", "x");
  const OutputFolder output(folder.path());
  EXPECT_TRUE(tells(sentenceOf([&] { output.write("x.json", "y"); }),
                    {folder.at("x.json"), "is a folder"}));
  EXPECT_EQ(filesIn(folder.path()), 1U);
  EXPECT_EQ(folder.read("x.json/inside"), "x");
}

TEST(OutputFolder, FileBehindALinkIsReplacedAndTheLinkStays) {
  const TemporaryFolder folder;
  folder.write("elsewhere/rooms.json", "old");
  std::filesystem::create_directory(folder.at("out"));
  std::filesystem::create_symlink("../elsewhere/rooms.json", folder.at("out/rooms.json"));
  OutputFolder(folder.at("out")).write("rooms.json", "new");
  EXPECT_EQ(folder.read("elsewhere/rooms.json"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.at("out/rooms.json")));
}

TEST(OutputFolder, LinkThatLeadsNowhereGivesWayToTheFile) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("gone", folder.at("x.json"));
  OutputFolder(folder.path()).write("x.json", "new");
  EXPECT_EQ(folder.read("x.json"), "new");
}

TEST(OutputFolder, PipesAndDevicesAndLinksToThemAreRefusedAndStay) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.at("pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink(folder.at("pipe"), folder.at("link"));
  const OutputFolder output(folder.path());
  for (const char* name : {"pipe", "link"}) {
    EXPECT_TRUE(tells(sentenceOf([&] { output.write(name, "y"); }),
                      {folder.at(name), "is a device or a pipe"}));
  }
  EXPECT_TRUE(std::filesystem::is_fifo(folder.at("pipe")));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.at("link")));
}

TEST(OutputFolder, FolderThatVanishedIsTold) {
  const TemporaryFolder folder;
  const OutputFolder output(folder.at("out"));
  std::filesystem::remove(folder.at("out"));
  EXPECT_TRUE(tells(sentenceOf([&] { output.write("x", "y"); }),
                    {folder.at("out/x"), "No such file or directory"}));
}

}  // namespace
}  // namespace occusg
