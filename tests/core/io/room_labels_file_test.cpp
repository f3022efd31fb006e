// SPDX-License-Identifier: BSD-3-Clause
#include "io/room_labels_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "occusg/error.hpp"

namespace occusg {
namespace {

TEST(RoomLabelsFile, TheShippedTableIsTheBuiltInOne) {
  const std::string path = std::string(OCCUSG_TEST_DATA) + "/../../config/room_labels.yaml";
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  EXPECT_EQ(text, toYaml(defaultRoomLabels()));
  EXPECT_EQ(readRoomLabels(path), defaultRoomLabels());
}

TEST(RoomLabelsFile, ReadsLabelsClassesAndWeights) {
  const RoomLabelTable table = roomLabelsFromYaml(
      "# mine\nden:\n  Arm Chair: 1.5  # soft\n  tv: 1\n\nempty:\n", "mine.yaml");
  EXPECT_EQ(table, (RoomLabelTable{{"den", {{"arm_chair", 1.5}, {"tv", 1.0}}}, {"empty", {}}}));
}

TEST(RoomLabelsFile, RefusesWhatIsNoTableAndNamesTheLine) {
  for (const char* yaml :
       {"den:\n  sofa: x\n", "den:\n  sofa: 0\n", "den:\n  sofa: nan\n", "den:\n  sofa: 1e9\n",
        "den:\n  sofa: 1\n  Sofa: 2\n", "den:\nden:\n", "den: 3\nsofa: 1\n", "\n  sofa: 1\n",
        "den:\n- sofa\n", "den:\n  : 1\n"}) {
    SCOPED_TRACE(yaml);
    try {
      (void)roomLabelsFromYaml(yaml, "mine.yaml");
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("mine.yaml:"), std::string::npos);
    }
  }
  EXPECT_THROW((void)readRoomLabels("/nonexistent/labels.yaml"), Error);
}

}  // namespace
}  // namespace occusg
