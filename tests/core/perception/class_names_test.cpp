// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/class_names.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg {
namespace {

using Names = std::vector<std::string>;

std::string refusal(const std::string& text) {
  try {
    (void)parseClassNames(text, "names.txt");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string refusalOfFile(const std::string& path) {
  try {
    (void)readClassNames(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ClassNames, AreTheLinesInOrder) {
  EXPECT_EQ(parseClassNames("chair\ndining table\nlamp", "names.txt"),
            (Names{"chair", "dining table", "lamp"}));
}

TEST(ClassNames, SpacesAndLineEndsOfOtherSystemsAreDropped) {
  EXPECT_EQ(parseClassNames("  chair \r\ntable\t\r\n\r\n\n", "names.txt"),
            (Names{"chair", "table"}));
}

TEST(ClassNames, BlankLineBetweenNamesIsRefusedWithItsNumber) {
  EXPECT_EQ(refusal("chair\n \nlamp\n"),
            "names.txt:2: is blank; each line before the last needs a name");
}

TEST(ClassNames, NoNameTooManyAndTooLongAreRefused) {
  EXPECT_EQ(refusal("\n\n"), "names.txt: holds no class name; one name a line is needed");
  std::string many;
  for (std::size_t i = 0; i <= kMaxClasses; ++i) many += "x\n";
  EXPECT_EQ(refusal(many), "names.txt: has 10001 class names; at most 10000 are read");
  EXPECT_EQ(refusal("chair\n" + std::string(kMaxClassNameLength + 1, 'x')),
            "names.txt:2: is 201 bytes long; a class name has at most 200");
}

TEST(ClassNames, AreReadFromAFile) {
  EXPECT_EQ(readClassNames(OCCUSG_TEST_DATA "/segmentation/classes.txt"),
            (Names{"chair", "table", "lamp"}));
}

TEST(ClassNames, MissingFileAndFolderAreRefusedByName) {
  EXPECT_EQ(refusalOfFile("nowhere.txt"),
            "nowhere.txt: is not a file; a list of class names, one a line, is needed");
  EXPECT_EQ(refusalOfFile(OCCUSG_TEST_DATA),
            OCCUSG_TEST_DATA ": is not a file; a list of class names, one a line, is needed");
}

}  // namespace
}  // namespace occusg
