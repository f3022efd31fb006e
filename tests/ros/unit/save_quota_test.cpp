// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>

#include "occusg/error.hpp"
#include "occusg_ros/saved_folder.hpp"

namespace occusg_ros {
namespace {

class SaveQuotas : public ::testing::Test {
 protected:
  SaveQuotas() {
    std::string pattern = (std::filesystem::temp_directory_path() / "occusg-saves-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = pattern;
  }
  ~SaveQuotas() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  void save(const std::string& name) const {
    std::filesystem::create_directory(folder_ + "/" + name);
  }

  std::string folder_;
};

TEST_F(SaveQuotas, FailureMode18PeersCannotFillTheDiskWithNames) {
  SaveQuota quota;
  quota.max_saves = 2;
  quota.min_free_disk_mb = 0.0;
  save("a");
  EXPECT_NO_THROW(checkQuota(folder_, "b", quota));
  save("b");
  EXPECT_THROW(checkQuota(folder_, "c", quota), occusg::Error);
  EXPECT_NO_THROW(checkQuota(folder_, "b", quota)) << "it replaces what is there";
  EXPECT_NO_THROW(checkQuota(folder_, kDefaultSaveName, quota)) << "the autosave is never refused";
}

TEST_F(SaveQuotas, FailureMode16ADiskThatIsNearlyFullIsKeptForTheAutosave) {
  SaveQuota quota;
  quota.min_free_disk_mb = 1e9;
  EXPECT_THROW(checkQuota(folder_, "a", quota), occusg::Error);
  EXPECT_NO_THROW(checkQuota(folder_, kDefaultSaveName, quota));
}

TEST_F(SaveQuotas, FailureMode18ANameIsNeverAPath) {
  for (const char* name : {"../x", "/x", ".hidden", "a/b", "a b"})
    EXPECT_THROW((void)checkedSaveName(name), occusg::Error) << name;
  EXPECT_EQ(checkedSaveName(""), kDefaultSaveName);
}

}  // namespace
}  // namespace occusg_ros
