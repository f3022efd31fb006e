// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/rooms_file.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "error_sentence.hpp"
#include "temporary_folder.hpp"

namespace occusg {
namespace {

using testing::sentenceOf;
using testing::tells;

RoomsFile parsed(const std::string& text) { return parseRooms(text, "r.json"); }

std::string parsingFails(const std::string& text) {
  return sentenceOf([&] { (void)parsed(text); });
}

std::string withRoom(const std::string& room) { return "{\"rooms\": [" + room + "]}"; }

constexpr const char* kTwoRooms = R"({"scene": "flat", "ceiling_z": 2.5, "floor_z": 0.1, "rooms": [
  {"id": 4, "label": "kitchen", "area": 12, "polygon": [[0, 0], [4, 0], [4, 3], [0, 3]]},
  {"id": 9, "polygon": [[4, 0], [4, 3], [8, 3], [8, 0], [4, 0]],
   "holes": [[[5, 1], [6, 1], [6, 2], [5, 2]]]}],
  "doors": [{"rooms": [4, 9], "segment": [[4, 1], [4, 2]], "kind": "door"}], "objects": [{}]})";

TEST(RoomsFile, ReadsRoomsHolesAndDoorsAndIgnoresOtherKeys) {
  const RoomsFile file = parsed(kTwoRooms);
  EXPECT_EQ(file.scene, "flat");
  EXPECT_EQ(file.frame, "map");
  EXPECT_EQ(file.floor_z_m, 0.1);
  ASSERT_EQ(file.rooms.size(), 2U);
  EXPECT_EQ(file.rooms[0].id, 4);
  EXPECT_EQ(file.rooms[0].label, "kitchen");
  EXPECT_EQ(file.rooms[1].label, "");
  EXPECT_EQ(area(file.rooms[1].polygon), 11.0);
  ASSERT_EQ(file.doors.size(), 1U);
  EXPECT_EQ(file.doors[0].room_a, 4);
  EXPECT_EQ(file.doors[0].room_b, 9);
  EXPECT_EQ(file.doors[0].segment.b, (Point2{4, 2}));
}

TEST(RoomsFile, RingsComeOutOrientedAndOpen) {
  const Polygon polygon = parsed(kTwoRooms).rooms[1].polygon;
  EXPECT_EQ(polygon.outer.size(), 4U);
  EXPECT_GT(signedArea(polygon.outer), 0.0);
  ASSERT_EQ(polygon.holes.size(), 1U);
  EXPECT_LT(signedArea(polygon.holes[0]), 0.0);
}

TEST(RoomsFile, NoRoomsIsAnEmptyFile) { EXPECT_TRUE(parsed("{\"rooms\": []}").rooms.empty()); }

TEST(RoomsFile, TextIsReadableAndOneRoomALine) {
  RoomsFile file;
  file.scene = "a \"b\"";
  file.rooms = {{2, "hall", {{{0, 0}, {1.00004, 0}, {1.00006, 0.1 + 0.2}}, {}}}};
  file.doors = {{2, 2, {{-0.00001, 1}, {2, 3}}}};
  EXPECT_EQ(toJson(file), R"({
"scene": "a \"b\"",
"frame": "map",
"floor_z": 0.0,
"rooms": [
  {"holes":[],"id":2,"label":"hall","polygon":[[0.0,0.0],[1.0,0.0],[1.0001,0.3]]}
],
"doors": [
  {"rooms":[2,2],"segment":[[0.0,1.0],[2.0,3.0]]}
]
}
)");
}

TEST(RoomsFile, EmptyFileIsStillComplete) {
  EXPECT_EQ(toJson(RoomsFile{}),
            "{\n\"scene\": \"\",\n\"frame\": \"map\",\n\"floor_z\": 0.0,\n\"rooms\": [],\n"
            "\"doors\": []\n}\n");
}

TEST(RoomsFile, WhatIsWrittenReadsBackAndWritesTheSameBytes) {
  const std::string text = toJson(parsed(kTwoRooms));
  const RoomsFile again = parsed(text);
  EXPECT_EQ(toJson(again), text);
  ASSERT_EQ(again.rooms.size(), 2U);
  EXPECT_EQ(again.rooms[1].polygon.holes, parsed(kTwoRooms).rooms[1].polygon.holes);
}

TEST(RoomsFile, StoreysAndTheRoomsOnThemReadBack) {
  const RoomsFile file = parsed(R"({"storeys": [
    {"id": 1, "floor_z": -2.8, "ceiling_z": -0.4, "name": "cellar"}, {"id": 0, "floor_z": 0.0}],
    "rooms": [{"id": 3, "storey": 1, "polygon": [[0, 0], [4, 0], [4, 3]]},
              {"id": 4, "storey": 0, "polygon": [[0, 0], [4, 0], [4, 3]]}]})");
  ASSERT_EQ(file.storeys.size(), 2U);
  EXPECT_EQ(file.storeys[0].id, 1);
  EXPECT_EQ(file.storeys[0].floor_z_m, -2.8);
  EXPECT_EQ(file.storeys[0].ceiling_z_m, -0.4);
  EXPECT_FALSE(file.storeys[1].ceiling_z_m);
  EXPECT_EQ(file.rooms[0].level, 1);
  EXPECT_EQ(toJson(parsed(toJson(file))), toJson(file));
  EXPECT_NE(toJson(file).find("\"storey\":1"), std::string::npos);
}

TEST(RoomsFile, StoreyThatAppearsTwiceIsRefused) {
  EXPECT_TRUE(tells(parsingFails(R"({"rooms": [], "storeys": [{"id": 2, "floor_z": 0.0},
                                                              {"id": 2, "floor_z": 3.0}]})"),
                    {"r.json", "storey id 2"}));
}

TEST(RoomsFile, LabelThatIsNotUtf8StillWritesValidJson) {
  RoomsFile file;
  file.scene = "\xFF";
  EXPECT_EQ(parsed(toJson(file)).scene, "\xEF\xBF\xBD");
}

TEST(RoomsFile, CoordinateThatIsNotFiniteIsNotWritten) {
  RoomsFile file;
  file.rooms = {{1, "", {{{0, 0}, {1, 0}, {1, std::numeric_limits<double>::quiet_NaN()}}, {}}}};
  EXPECT_TRUE(tells(sentenceOf([&] { (void)toJson(file); }), {"not finite"}));
}

TEST(RoomsFile, ReadsFromDiskAndNamesTheFile) {
  const testing::TemporaryFolder folder;
  folder.write("rooms.json", kTwoRooms);
  EXPECT_EQ(readRooms(folder.at("rooms.json")).rooms.size(), 2U);
  EXPECT_TRUE(tells(sentenceOf([&] { (void)readRooms(folder.at("no.json")); }),
                    {folder.at("no.json"), "does not exist"}));
  EXPECT_TRUE(tells(sentenceOf([&] { (void)readRooms(folder.path()); }),
                    {folder.path(), "is not a regular file"}));
}

TEST(RoomsFile, FileBeyondTheLimitIsRefusedUnread) {
  const testing::TemporaryFolder folder;
  folder.write("rooms.json", "{}");
  std::filesystem::resize_file(folder.at("rooms.json"), (64U << 20U) + 1U);  // sparse
  EXPECT_TRUE(tells(sentenceOf([&] { (void)readRooms(folder.at("rooms.json")); }),
                    {"is 67108865 bytes long", "at most 67108864"}));
}

TEST(RoomsFile, FaultsAreToldWithFileRoomAndValue) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"", {"r.json:1", "not valid JSON"}},
      {"{\n\n\"rooms\": [}", {"r.json:3", "not valid JSON"}},
      {"{\"rooms\": []} x", {"r.json:1", "not valid JSON"}},
      {"[]", {"r.json", "an array of 0", "an object is needed"}},
      {"{}", {"r.json", "has no \"rooms\""}},
      {R"({"rooms": {}})", {"r.json: rooms", "an object", "an array is needed"}},
      {R"({"rooms": [3]})", {"rooms[0]", "is 3", "an object is needed"}},
      {R"({"rooms": [], "scene": 3})", {"r.json: scene", "is 3", "a string is needed"}},
      {R"({"rooms": [], "frame": null})", {"r.json: frame", "is null", "a string is needed"}},
      {R"({"rooms": [], "floor_z": "0"})", {"r.json: floor_z", "is \"0\"", "finite number"}},
      {R"({"rooms": [], "doors": 1})", {"r.json: doors", "is 1", "an array is needed"}},
      {withRoom("{}"), {"rooms[0]", "has no \"id\""}},
      {withRoom(R"({"id": "x"})"), {"rooms[0] id", "is \"x\"", "an integer"}},
      {withRoom(R"({"id": 7})"), {"r.json: room 7", "has no \"polygon\""}},
      {withRoom(R"({"id": 7, "label": []})"), {"room 7 label", "an array of 0", "a string"}},
      {withRoom(R"({"id": 7, "polygon": [[0, 0], [1, 0]]})"),
       {"room 7 polygon", "has 2 vertices", "at least 3"}},
      {withRoom(R"({"id": 7, "polygon": [[0, 0], [1, 0], [0, 0]]})"),
       {"room 7 polygon", "has 2 vertices", "at least 3"}},
      {withRoom(R"({"id": 7, "polygon": [[0, 0], [1, 0], [1]]})"),
       {"room 7 polygon vertex 2", "has 1 numbers", "[x, y]"}},
      {withRoom(R"({"id": 7, "polygon": [[0, 0], [1, 0], [1, null]]})"),
       {"room 7 polygon vertex 2 y", "is null", "finite number"}},
      {withRoom(R"({"id": 7, "polygon": [[0, 0], [1, 0], [1, 1e999]]})"),
       {"r.json", "not valid JSON"}},
      {withRoom(R"({"id": 7, "polygon": [[0, 0], [1, 0], [1, 1e7]]})"),
       {"room 7 polygon vertex 2 y", "10000000.0 m", "within 1e6 m"}},
      {withRoom(R"({"id": 7, "polygon": [[0, 0], [1, 0], [1, 1]], "holes": [[[0, 0]]]})"),
       {"room 7 hole 0", "has 1 vertices"}},
      {withRoom(R"({"id": 7, "polygon": [[0, 0], [1, 0], [1, 1]]},
                   {"id": 7, "polygon": [[0, 0], [1, 0], [1, 1]]})"),
       {"r.json", "room id 7 appears twice"}},
      {R"({"rooms": [], "doors": [{"rooms": [1]}]})", {"doors[0]", "joins 1 rooms"}},
      {R"({"rooms": [], "doors": [{"rooms": [1, 2]}]})", {"doors[0]", "names room 1"}},
      {withRoom(R"({"id": 1, "polygon": [[0, 0], [1, 0], [1, 1]]}], "doors": [)"
                R"({"rooms": [1, 1], "segment": [[0, 0]]})"),
       {"doors[0]", "segment: has 1 points"}},
  };
  for (const auto& [text, parts] : cases) {
    SCOPED_TRACE(text);
    EXPECT_TRUE(tells(parsingFails(text), parts));
  }
}

std::string repeated(std::size_t count, const std::string& text) {
  std::string result;
  result.reserve(count * (text.size() + 1));
  for (std::size_t i = 0; i < count; ++i) result += (i == 0 ? "" : ",") + text;
  return result;
}

TEST(RoomsFile, CountsAreCapped) {
  EXPECT_TRUE(tells(parsingFails("{\"rooms\": [" + repeated(kMaxRooms + 1, "1") + "]}"),
                    {"r.json", "has 166667 rooms", "at most 166666"}));
  EXPECT_TRUE(tells(parsingFails(withRoom("{\"id\": 1, \"polygon\": [" +
                                          repeated(kMaxRoomVertices + 1, "[0,0]") + "]}")),
                    {"r.json", "more than 500000 vertices"}));
  EXPECT_TRUE(
      tells(parsingFails("{\"rooms\": [], \"doors\": [" + repeated(kMaxGraphEdges + 1, "1") + "]}"),
            {"has 1000001 doors", "at most 1000000"}));
  EXPECT_TRUE(
      tells(parsingFails("{\"rooms\": [], \"x\": [" + repeated(kMaxGraphValues + 1, "1") + "]}"),
            {"r.json", "more than 8000000 values"}));
}

TEST(RoomsFile, NestingIsCapped) {
  EXPECT_TRUE(
      tells(parsingFails(std::string(1'000'000, '[')), {"r.json", "deeper than 32 levels"}));
  EXPECT_TRUE(parsed("{\"rooms\": [], \"x\": " + std::string(30, '[') + std::string(30, ']') + "}")
                  .rooms.empty());
}

}  // namespace
}  // namespace occusg
