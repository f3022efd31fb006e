// SPDX-License-Identifier: BSD-3-Clause
#include "io/folder_exchange.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string>

#include "error_sentence.hpp"
#include "temporary_folder.hpp"

namespace {

/// How the file system behaves: set by a test, read by the calls below, which stand in for libc's.
struct FileSystem {
  bool can_exchange = true;
  int renames_until_kill = -1;  ///< The process ends instead of the rename after so many.
  int failing_rename = -1;      ///< The rename after so many fails.
};
FileSystem file_system;

}  // namespace

extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to,
                         unsigned flags) noexcept {
  if (!file_system.can_exchange && flags != 0) {
    errno = EINVAL;
    return -1;
  }
  using Call = int (*)(int, const char*, int, const char*, unsigned);
  static const Call call = reinterpret_cast<Call>(::dlsym(RTLD_NEXT, "renameat2"));
  return call(from_folder, from, to_folder, to, flags);
}

extern "C" int rename(const char* from, const char* to) noexcept {
  if (file_system.renames_until_kill-- == 0) ::kill(::getpid(), SIGKILL);
  if (file_system.failing_rename-- == 0) {
    errno = EIO;
    return -1;
  }
  using Call = int (*)(const char*, const char*);
  static const Call call = reinterpret_cast<Call>(::dlsym(RTLD_NEXT, "rename"));
  return call(from, to);
}

namespace occusg {
namespace {

namespace fs = std::filesystem;
using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;

class FolderExchange : public ::testing::Test {
 protected:
  FolderExchange() {
    folder_.write("place/file", "old");
    folder_.write("fresh/file", "new");
  }
  FolderExchange(const FolderExchange&) = delete;
  FolderExchange& operator=(const FolderExchange&) = delete;
  ~FolderExchange() override { file_system = {}; }

  void exchange() const { putInPlace(folder_.at("fresh"), folder_.at("place")); }
  [[nodiscard]] std::string standing() const {
    return folder_.read(standingFolder(folder_.at("place")) / "file");
  }
  /// Everything but `fresh`, which its owner removes.
  [[nodiscard]] bool leavesNothingBeside() const {
    return !fs::exists(placeOfTheSetAside(folder_.at("place")));
  }

  TemporaryFolder folder_;
};

TEST_F(FolderExchange, PutsTheNewInPlaceOfTheOld) {
  exchange();
  EXPECT_EQ(folder_.read("place/file"), "new");
  EXPECT_TRUE(leavesNothingBeside());
}

TEST_F(FolderExchange, FileSystemWithoutExchangeGetsTheNewInPlaceEveryTime) {
  file_system.can_exchange = false;
  for (const std::string text : {"new", "newer", "newest"}) {
    fs::remove_all(folder_.at("fresh"));
    folder_.write("fresh/file", text);
    exchange();
    EXPECT_EQ(folder_.read("place/file"), text);
    EXPECT_TRUE(leavesNothingBeside());
  }
}

TEST_F(FolderExchange, FailureMode14KillAtAnyRenameWithoutExchangeLeavesTheOldOrTheNew) {
  file_system.can_exchange = false;
  int kills = 0;
  for (int renames = 0; renames < 5; ++renames) {
    const TemporaryFolder work;
    work.write("place/file", "old");
    work.write("fresh/file", "new");
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      file_system.renames_until_kill = renames;
      putInPlace(work.at("fresh"), work.at("place"));
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    kills += WIFSIGNALED(status) ? 1 : 0;
    const auto read = [&] { return work.read(standingFolder(work.at("place")) / "file"); };
    EXPECT_EQ(read(), WIFSIGNALED(status) ? "old" : "new") << "killed at rename " << renames;
    // The next save succeeds and clears up.
    fs::remove_all(work.at("fresh"));
    work.write("fresh/file", "next");
    putInPlace(work.at("fresh"), work.at("place"));
    EXPECT_EQ(work.read("place/file"), "next");
    EXPECT_FALSE(fs::exists(placeOfTheSetAside(work.at("place"))));
  }
  EXPECT_GE(kills, 3);
}

TEST_F(FolderExchange, RenameThatFailsLeavesTheOldInPlace) {
  file_system.can_exchange = false;
  file_system.failing_rename = 2;  // after the attempt in one step and setting aside
  EXPECT_TRUE(tells(sentenceOf([&] { exchange(); }), {"place", "cannot be replaced"}));
  EXPECT_EQ(folder_.read("place/file"), "old");
  EXPECT_EQ(standing(), "old");
}

}  // namespace
}  // namespace occusg
