// SPDX-License-Identifier: BSD-3-Clause
#include "io/result_index.hpp"

#include <gtest/gtest.h>

#include "error_sentence.hpp"
#include "temporary_folder.hpp"

namespace occusg {
namespace {

using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;
using Names = std::vector<std::string>;

TEST(ResultIndex, FolderWithoutAnIndexSaysNothing) {
  const TemporaryFolder folder;
  EXPECT_FALSE(filesOfOtherRuns(folder.path()).has_value());
  folder.write(kResultIndexFile, "{\"of\": \"another program\"}");
  EXPECT_FALSE(filesOfOtherRuns(folder.path()).has_value());
}

TEST(ResultIndex, NamesTheFilesThatAreMissingOrOfAnotherRun) {
  const TemporaryFolder folder;
  folder.write("a", "first");
  folder.write("b", "second");
  folder.write("c", "third");
  folder.write(
      kResultIndexFile,
      toResultIndex({{"a", markOf("first")}, {"b", markOf("second")}, {"c", markOf("third")}}));
  EXPECT_EQ(filesOfOtherRuns(folder.path()), Names{});
  folder.write("a", "frist");      // as long as before
  folder.write("c", "something");  // longer
  EXPECT_EQ(filesOfOtherRuns(folder.path()), (Names{"a", "c"}));
  std::filesystem::remove(folder.at("b"));
  EXPECT_EQ(filesOfOtherRuns(folder.path()), (Names{"a", "b", "c"}));
}

TEST(ResultIndex, IndexThatNamesFilesElsewhereIsRefused) {
  const TemporaryFolder folder;
  folder.write(kResultIndexFile, toResultIndex({{"../a", markOf("")}}));
  EXPECT_TRUE(tells(sentenceOf([&] { (void)filesOfOtherRuns(folder.path()); }),
                    {kResultIndexFile, "another folder"}));
}

}  // namespace
}  // namespace occusg
