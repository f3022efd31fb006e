// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/saved_generations.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace occusg_ros {
namespace {

namespace fs = std::filesystem;

class SavedGenerationsTest : public ::testing::Test {
 protected:
  SavedGenerationsTest() {
    std::string pattern = (fs::temp_directory_path() / "occusg-generations-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~SavedGenerationsTest() override { fs::remove_all(folder_); }

  /// A life that saves `content` as "last".
  void live(const std::string& run_id, const std::string& content) {
    const SavedGenerations generations(folder_, run_id, "/occusg/mapping");
    generations.makeRoom();
    std::ofstream(fs::path(folder_) / "last" / "map.ot") << content;
  }
  [[nodiscard]] std::string contentOf(const std::string& name) const {
    std::ifstream file(fs::path(folder_) / name / "map.ot");
    std::string content;
    std::getline(file, content);
    return content;
  }

  std::string folder_;
};

TEST_F(SavedGenerationsTest, FailureMode19WhatEarlierLivesSavedIsKeptThreeGenerationsLong) {
  for (const std::string life : {"a", "b", "c", "d", "e"}) live(life, life);
  EXPECT_EQ(contentOf("last"), "e");
  EXPECT_EQ(contentOf("last.1"), "d");
  EXPECT_EQ(contentOf("last.2"), "c");
  EXPECT_EQ(contentOf("last.3"), "b");
  EXPECT_FALSE(fs::exists(fs::path(folder_) / "last.4"));
}

TEST_F(SavedGenerationsTest, NodesOfOneLifeWriteIntoTheSameLast) {
  live("a", "first");
  live("a", "second");
  EXPECT_EQ(contentOf("last"), "second");
  EXPECT_FALSE(fs::exists(fs::path(folder_) / "last.1"));
}

TEST_F(SavedGenerationsTest, WhatCannotBeLoadedIsSetAsideUnderAnotherName) {
  live("a", "damaged");
  const SavedGenerations generations(folder_, "b", "/occusg/mapping");
  const std::string aside = generations.setAside("last");
  EXPECT_EQ(aside.rfind("last.refused-", 0), 0U) << aside;
  EXPECT_EQ(contentOf(aside), "damaged");
  EXPECT_EQ(generations.setAside("last"), "") << "the other node was first";
  live("b", "anew");
  EXPECT_EQ(contentOf(aside), "damaged");
}

TEST_F(SavedGenerationsTest, FailureMode19NodeThatIsRespawnedKnowsThatItHasCrashed) {
  EXPECT_FALSE(SavedGenerations(folder_, "a", "/occusg/mapping").hasCrashed());
  EXPECT_FALSE(SavedGenerations(folder_, "a", "/occusg/mapping").hasCrashed())
      << "it ended as it should";
  // What is left by a process that was killed.
  std::ofstream(fs::path(folder_) / ".running_occusg_mapping") << "a\n";
  EXPECT_TRUE(SavedGenerations(folder_, "a", "/occusg/mapping").hasCrashed());
  std::ofstream(fs::path(folder_) / ".running_occusg_mapping") << "a\n";
  EXPECT_FALSE(SavedGenerations(folder_, "b", "/occusg/mapping").hasCrashed()) << "another life";
}

}  // namespace
}  // namespace occusg_ros
