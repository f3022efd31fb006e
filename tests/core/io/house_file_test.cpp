// SPDX-License-Identifier: BSD-3-Clause
#include "io/house_file.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "error_sentence.hpp"
#include "io/external_rooms.hpp"
#include "io/file_bytes.hpp"
#include "io/object_records.hpp"
#include "temporary_folder.hpp"

namespace occusg {
namespace {

using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;

std::string house() {
  return readFile(std::string(OCCUSG_TEST_DATA) + "/mp3d/small.house", 1 << 20);
}

const RoomRecord& roomWithId(const HouseTruth& truth, int id) {
  for (const RoomRecord& room : truth.rooms.rooms)
    if (room.id == id) return room;
  throw std::runtime_error("no such room");
}

TEST(HouseFile, FootprintIsTheUnionOfFloorsAndCeilings) {
  const HouseTruth truth = parseHouse(house(), "small.house", std::nullopt);
  ASSERT_EQ(truth.rooms.rooms.size(), 4U);
  const RoomRecord& living_room = roomWithId(truth, 1);
  EXPECT_EQ(living_room.label, "living_room");
  EXPECT_NEAR(area(living_room.polygon), 16.0 + 4.0, 1e-6) << "floor and the ceiling beside it";
  EXPECT_TRUE(living_room.further_parts.empty());
}

TEST(HouseFile, WallsDoNotCountAndAHullStandsInForAMissingFloor) {
  const HouseTruth truth = parseHouse(house(), "small.house", std::nullopt);
  EXPECT_NEAR(area(roomWithId(truth, 2).polygon), 9.0, 1e-6);
}

TEST(HouseFile, RoomInTwoPiecesKeepsBoth) {
  const RoomRecord hallway = roomWithId(parseHouse(house(), "small.house", std::nullopt), 3);
  EXPECT_EQ(hallway.further_parts.size(), 1U);
}

TEST(HouseFile, RegionWithoutFootprintIsLeftOutAndSaidSo) {
  const HouseTruth truth = parseHouse(house(), "small.house", std::nullopt);
  ASSERT_EQ(truth.notes.size(), 1U);
  EXPECT_TRUE(tells(truth.notes[0], {"region 4", "no footprint"}));
}

TEST(HouseFile, PortalsAreDoorsAndPanoramasAreNot) {
  const HouseTruth truth = parseHouse(house(), "small.house", std::nullopt);
  ASSERT_EQ(truth.rooms.doors.size(), 1U);
  EXPECT_EQ(truth.rooms.doors[0].room_a, 1);
  EXPECT_EQ(truth.rooms.doors[0].room_b, 2);
  EXPECT_EQ(truth.rooms.doors[0].segment.a, (Point2{6.0, 1.0}));
  EXPECT_EQ(truth.rooms.doors[0].segment.b, (Point2{6.0, 2.0}));
}

TEST(HouseFile, OneLevelCanBeChosen) {
  const HouseTruth upstairs = parseHouse(house(), "small.house", 1);
  ASSERT_EQ(upstairs.rooms.rooms.size(), 1U);
  EXPECT_EQ(upstairs.rooms.rooms[0].level, 1);
  EXPECT_TRUE(upstairs.rooms.doors.empty());
  EXPECT_TRUE(tells(sentenceOf([] { (void)parseHouse(house(), "small.house", 7); }),
                    {"small.house", "level 7"}));
}

TEST(HouseFile, WrittenTruthReadsBackWithLevelsAndParts) {
  const RoomsFile rooms = parseHouse(house(), "small.house", std::nullopt).rooms;
  const RoomsFile back = parseRooms(toJson(rooms), "rooms.json");
  ASSERT_EQ(back.rooms.size(), 4U);
  EXPECT_EQ(back.rooms[2].further_parts.size(), 1U);
  EXPECT_EQ(back.rooms[3].level, 1);
}

TEST(HouseFile, RefusesBrokenRecordsNamingTheLine) {
  const auto refusal = [](const std::string& text) {
    return sentenceOf([&] { (void)parseHouse(text, "a.house", std::nullopt); });
  };
  EXPECT_TRUE(tells(refusal("ASCII 1.1\n"), {"a.house", "no region"}));
  EXPECT_TRUE(tells(refusal("R 0 0\n"), {"a.house:1", "3 words"}));
  EXPECT_TRUE(tells(refusal("R x 0 0 0 b\n"), {"a.house:1", "'x'", "integer"}));
  EXPECT_TRUE(tells(refusal("R 0 0 0 0 b\nR 0 0 0 0 b\n"), {"a.house:2", "twice"}));
  EXPECT_TRUE(tells(refusal("R 0 0 0 0 b\nV 0 9 w 0 0 0\n"), {"a.house:2", "surface 9"}));
  EXPECT_TRUE(tells(refusal("R 0 0 0 0 b\nS 0 0 0 F 0 0 0 0 0 1\nV 0 0 F nan 0 0\n"),
                    {"a.house:3", "'nan'"}));
  EXPECT_TRUE(tells(refusal("R 0 0 0 0 b\n"), {"a.house", "footprint"}));
}

TEST(ExternalRooms, RoomsWithoutIntegerIdsAreNumbered) {
  const TemporaryFolder folder;
  folder.write("a.json", R"json({"rooms": [{"id": "R(0)", "polygon": [[0,0],[1,0],[1,1]]},
                                           {"polygon": [[2,0],[3,0],[3,1]]}],
                                 "doors": [{"rooms": ["R(0)", "R(1)"]}]})json");
  const RoomsFile rooms = readExternalRooms(folder.at("a.json"));
  ASSERT_EQ(rooms.rooms.size(), 2U);
  EXPECT_EQ(rooms.rooms[1].id, 2);
  folder.write("b.json", R"json({"rooms": [{"id": 7, "polygon": [[0,0],[1,0],[1,1]]}]})json");
  EXPECT_EQ(readExternalRooms(folder.at("b.json")).rooms.at(0).id, 7);
  folder.write("c.json", R"json({"rooms": ["R"]})json");
  EXPECT_TRUE(tells(sentenceOf([&] { (void)readExternalRooms(folder.at("c.json")); }),
                    {"c.json", "object"}));
}

TEST(ObjectRecords, TruthLeavesOutWhatNobodySaw) {
  const std::string rooms =
      R"({"objects": [{"id": 1, "label": "bed", "bbox": [[0,0,0],[2,1,1]], "room": 3},
                      {"id": 2, "label": "cup", "bbox": [[0,0,0],[1,1,1]], "room": null}]})";
  EXPECT_EQ(parseTruthObjects(rooms, "rooms.json", std::nullopt).size(), 2U);
  const auto seen =
      parseTruthObjects(rooms, "rooms.json", R"([{"id": 1, "pixels": 9}, {"id": 2, "pixels": 0}])");
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].position, (Point2{1.0, 0.5}));
  EXPECT_EQ(seen[0].room_id, 3);
  EXPECT_TRUE(parseTruthObjects("{}", "rooms.json", std::nullopt).empty());
  EXPECT_TRUE(tells(sentenceOf([] {
                      (void)parseTruthObjects(
                          R"({"objects": [{"id": 5, "label": "bed", "bbox": [[0,0,0]]}]})",
                          "rooms.json", std::nullopt);
                    }),
                    {"object 5 bbox", "1 corners"}));
}

TEST(ObjectRecords, GraphObjectsAreInTheRoomThatContainsThem) {
  const auto objects = parseGraphObjects(
      R"({"nodes": [{"id": 1, "type": "ROOM", "name": "room_12"},
                    {"id": 2, "type": "OBJECT", "class": "bed", "position": [1, 2, 3]},
                    {"id": 3, "type": "OBJECT", "class": "cup", "position": [4, 5, 6]}],
          "edges": [{"type": "ROOM_CONTAINS", "source": 1, "target": 2},
                    {"type": "NEAREST_FREE_SPACE", "source": 3, "target": 9}]})",
      "graph.json");
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].room_id, 12);
  EXPECT_FALSE(objects[1].room_id.has_value());
  EXPECT_TRUE(tells(sentenceOf([] {
                      (void)parseGraphObjects(
                          R"({"nodes": [{"id": 1, "type": "ROOM", "name": "attic"}], "edges": []})",
                          "graph.json");
                    }),
                    {"node 1", "'attic'"}));
}

}  // namespace
}  // namespace occusg
