// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/octomap_file.hpp"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/octomap.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "error_sentence.hpp"
#include "temporary_folder.hpp"
#include "voxel_scenes.hpp"

namespace occusg {
namespace {

using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;

OccupancyMap scannedRoom() {
  OccupancyMap map{OccupancyMapConfig{}};
  std::mt19937 random(4);
  for (int i = 0; i < 4; ++i)
    map.insert(testing::scanOfBox({0.1F, 0.2F, 1.0F}, {{-1.0F, -1.5F, 0.0F}, {1.0F, 1.5F, 2.0F}},
                                  800, random));
  return map;
}

/// Key, depth and value of every node, inner nodes included.
std::string nodesOf(const octomap::OcTree& tree) {
  std::ostringstream nodes;
  for (auto node = tree.begin_tree(), end = tree.end_tree(); node != end; ++node) {
    const octomap::OcTreeKey key = node.getIndexKey();
    nodes << key[0] << ' ' << key[1] << ' ' << key[2] << ' ' << node.getDepth() << ' '
          << node->getLogOdds() << '\n';
  }
  return nodes.str();
}

std::string header(const std::string& size, const std::string& rest = "res 0.05\ndata\n",
                   const std::string& kind = "", const std::string& id = "OcTree") {
  return "# Octomap OcTree " + kind + "file\n# comment\nid " + id + "\nsize " + size + "\n" + rest;
}

/// Writes the bytes and reads them as a map.
class OctomapFile : public ::testing::Test {
 protected:
  OccupancyMap read(const std::string& bytes, std::size_t max_nodes = kMaxOctomapNodes) {
    folder_.write("map", bytes);
    return readOctomap(folder_.at("map"), OccupancyMapConfig{}, max_nodes);
  }
  std::string refusal(const std::string& bytes, std::size_t max_nodes = kMaxOctomapNodes) {
    return sentenceOf([&] { (void)read(bytes, max_nodes); });
  }

  TemporaryFolder folder_;
};

TEST_F(OctomapFile, FullFileOfTheLibraryRoundTripsNodeByNode) {
  const OccupancyMap map = scannedRoom();
  std::ostringstream file;
  ASSERT_TRUE(map.tree().write(file));
  EXPECT_EQ(nodesOf(read(file.str()).tree()), nodesOf(map.tree()));
}

TEST_F(OctomapFile, BinaryFileOfTheLibraryGivesTheTreeTheLibraryReads) {
  const OccupancyMap map = scannedRoom();
  std::ostringstream file;
  ASSERT_TRUE(map.tree().writeBinaryConst(file));
  octomap::OcTree expected(0.05);
  expected.setClampingThresMin(0.12);
  expected.setClampingThresMax(0.97);
  std::istringstream bytes(file.str());
  ASSERT_TRUE(expected.readBinary(bytes));
  expected.prune();
  EXPECT_EQ(nodesOf(read(file.str()).tree()), nodesOf(expected));
}

TEST_F(OctomapFile, LibraryReadsBothOfOurEncodings) {
  const OccupancyMap map = scannedRoom();
  std::istringstream full(toOctomap(map.tree(), OctomapEncoding::kFull));
  const std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(full));
  const auto* tree = dynamic_cast<octomap::OcTree*>(read.get());
  ASSERT_NE(tree, nullptr);
  EXPECT_EQ(nodesOf(*tree), nodesOf(map.tree()));

  octomap::OcTree binary(0.1);
  std::istringstream bytes(toOctomap(map.tree(), OctomapEncoding::kBinary));
  ASSERT_TRUE(binary.readBinary(bytes));
  EXPECT_EQ(binary.size(), map.tree().size());
  EXPECT_EQ(binary.getResolution(), 0.05);
}

TEST_F(OctomapFile, ColoursAreLeftOut) {
  octomap::ColorOcTree colored(0.05);
  octomap::OcTree plain(0.05);
  for (int i = 0; i < 50; ++i) {
    const octomap::point3d place(0.05F * static_cast<float>(i), 0.02F, -0.3F);
    colored.updateNode(place, i % 3 != 0);
    colored.integrateNodeColor(place.x(), place.y(), place.z(), 200, 10, 90);
    plain.updateNode(place, i % 3 != 0);
  }
  std::ostringstream file;
  ASSERT_TRUE(colored.write(file));
  EXPECT_EQ(nodesOf(read(file.str()).tree()), nodesOf(plain));
}

TEST_F(OctomapFile, ValuesBeyondTheClampsAndStaleInnerValuesAreMended) {
  octomap::OcTree tree(0.05);
  tree.setNodeValue(octomap::point3d(0.01F, 0.01F, 0.01F), 50.0F);
  tree.getRoot()->setLogOdds(-7.0F);
  std::ostringstream file;
  ASSERT_TRUE(tree.write(file));
  const OccupancyMap map = read(file.str());
  EXPECT_FLOAT_EQ(map.tree().getRoot()->getLogOdds(), map.tree().getClampingThresMaxLog());
}

TEST_F(OctomapFile, MapThatWasReadGoesOnLikeTheOneThatWasSaved) {
  OccupancyMap map = scannedRoom();
  OccupancyMap again = read(toOctomap(map.tree(), OctomapEncoding::kFull));
  std::mt19937 random(9);
  for (int i = 0; i < 3; ++i) {
    const PointCloud cloud = testing::randomCloud(300, random);
    EXPECT_EQ(again.insert(cloud).columns, map.insert(cloud).columns);
  }
  EXPECT_EQ(nodesOf(again.tree()), nodesOf(map.tree()));
}

TEST_F(OctomapFile, EmptyMapRoundTrips) {
  const octomap::OcTree empty(0.05);
  for (const auto encoding : {OctomapEncoding::kFull, OctomapEncoding::kBinary})
    EXPECT_EQ(read(toOctomap(empty, encoding)).tree().size(), 0U);
}

TEST_F(OctomapFile, HeaderIsReadWithoutTheTree) {
  folder_.write("map", header("123456789", "res 0.1\ndata\nnothing that fits"));
  const OctomapHeader found = readOctomapHeader(folder_.at("map"));
  EXPECT_EQ(found.encoding, OctomapEncoding::kFull);
  EXPECT_EQ(found.node_count, 123'456'789U);
  EXPECT_DOUBLE_EQ(found.resolution_m, 0.1);
}

TEST_F(OctomapFile, FailureMode17EveryTruncationIsRefused) {
  OccupancyMap small{OccupancyMapConfig{}};
  testing::insertSlice(small, {"..#", ".#.", "###"});
  for (const auto encoding : {OctomapEncoding::kFull, OctomapEncoding::kBinary}) {
    const std::string bytes = toOctomap(small.tree(), encoding);
    ASSERT_LT(bytes.size(), 2000U);
    for (std::size_t length = 0; length < bytes.size(); ++length)
      EXPECT_TRUE(tells(refusal(bytes.substr(0, length)), {"map", ";"})) << length;
  }
}

TEST_F(OctomapFile, FlippedBytesAreRefusedOrGiveATreeOfTheDeclaredSize) {
  OccupancyMap small{OccupancyMapConfig{}};
  testing::insertSlice(small, {"..#", ".#.", "###"});
  constexpr unsigned kSeed = 20;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string bytes =
        toOctomap(small.tree(), i % 2 == 0 ? OctomapEncoding::kFull : OctomapEncoding::kBinary);
    for (unsigned flips = 1 + random() % 4; flips > 0; --flips)
      bytes[random() % bytes.size()] = static_cast<char>(random());
    folder_.write("map", bytes);
    try {
      const OccupancyMap map = readOctomap(folder_.at("map"), OccupancyMapConfig{});
      EXPECT_LE(map.tree().size(), readOctomapHeader(folder_.at("map")).node_count);
      EXPECT_EQ(map.tree().size(), map.tree().calcNumNodes());
    } catch (const Error& error) {
      ++refused;
      EXPECT_TRUE(tells(error.what(), {";"}));
    }
  }
  EXPECT_GT(refused, 300);
}

TEST_F(OctomapFile, FailureMode17DeclaredCountsAreCappedAndChecked) {
  EXPECT_TRUE(tells(refusal(header("999999999999")), {"999999999999 nodes", "at most 67108864"}));
  EXPECT_TRUE(tells(refusal(header("99999999999999999999999")), {"map:4", "size"}));
  EXPECT_TRUE(tells(refusal(header("-3")), {"map:4", "size is \"-3\""}));
  EXPECT_TRUE(tells(refusal(header("60000000")), {"ends at byte", "60000000 are declared"}));
  const OccupancyMap map = scannedRoom();
  const std::string bytes = toOctomap(map.tree(), OctomapEncoding::kFull);
  EXPECT_TRUE(tells(refusal(bytes, 100), {"at most 100 are read"}));
  EXPECT_TRUE(tells(refusal(bytes + "x"), {"goes on for 1 bytes"}));
  const std::string size = "size " + std::to_string(map.tree().size());
  for (const int difference : {-1, 1}) {
    std::string other = bytes;
    other.replace(other.find(size), size.size(),
                  "size " + std::to_string(static_cast<int>(map.tree().size()) + difference));
    EXPECT_TRUE(tells(refusal(other), {"are declared"})) << difference;
  }
}

TEST_F(OctomapFile, DeepNestingIsRefusedAtLevelSeventeen) {
  const std::string full_node{0, 0, 0, 0, 1};
  const std::string binary_node{3, 0};
  std::string full = header("200000");
  std::string binary = header("200000", "res 0.05\ndata\n", "binary ");
  for (int i = 0; i < 200'000; ++i) {
    full += full_node;
    binary += binary_node;
  }
  EXPECT_TRUE(tells(refusal(full), {"below level 16"}));
  EXPECT_TRUE(tells(refusal(binary), {"below level 16"}));
}

TEST_F(OctomapFile, WholeTreeOfAnotherCountIsReadWhereThatMayBeSaid) {
  const OccupancyMap map = scannedRoom();
  std::string bytes = toOctomap(map.tree(), OctomapEncoding::kFull);
  const std::string size = "size " + std::to_string(map.tree().size());
  bytes.replace(bytes.find(size), size.size(), "size 17");
  folder_.write("map", bytes);
  std::vector<std::string> assumptions;
  const OccupancyMap read =
      readOctomap(folder_.at("map"), OccupancyMapConfig{}, kMaxOctomapNodes, &assumptions);
  EXPECT_EQ(read.tree().size(), map.tree().size());
  ASSERT_EQ(assumptions.size(), 1U);
  EXPECT_TRUE(tells(assumptions.front(), {"17 are declared", "was read"}));
}

TEST_F(OctomapFile, HeaderOfOctoMapBeforeOneIsRead) {
  const std::int32_t type = 3;
  const double resolution_m = 0.05;
  const std::uint32_t nodes = 3;
  std::string bytes(reinterpret_cast<const char*>(&type), sizeof(type));
  bytes.append(reinterpret_cast<const char*>(&resolution_m), sizeof(resolution_m));
  bytes.append(reinterpret_cast<const char*>(&nodes), sizeof(nodes));
  for (int i = 0; i < 15; ++i) bytes += std::string{3, 0};
  bytes += std::string{2, 0};
  folder_.write("old.bt", bytes);
  std::vector<std::string> assumptions;
  const OccupancyMap map =
      readOctomap(folder_.at("old.bt"), OccupancyMapConfig{}, kMaxOctomapNodes, &assumptions);
  EXPECT_EQ(map.tree().getNumLeafNodes(), 1U);
}

TEST_F(OctomapFile, FailureMode17FewBytesThatStandForABuildingAreRefused) {
  // A chain of inner nodes down to one pruned leaf of 2048 voxels a side.
  std::string bomb = header("6", "res 0.05\ndata\n", "binary ");
  for (int i = 0; i < 4; ++i) bomb += std::string{3, 0};
  bomb += std::string{1, 0};
  EXPECT_TRUE(tells(refusal(bomb), {"stands for more than", "blocks", "max_memory_mb"}));
  // A leaf of 64 voxels a side is a hall.
  std::string hall = header("11", "res 0.05\ndata\n", "binary ");
  for (int i = 0; i < 9; ++i) hall += std::string{3, 0};
  hall += std::string{1, 0};
  folder_.write("hall.bt", hall);
  EXPECT_EQ(readOctomap(folder_.at("hall.bt"), {}).tree().getNumLeafNodes(), 1U);
}

TEST_F(OctomapFile, TreesThatCannotBeAreRefused) {
  const std::string leaf(5, '\0');
  EXPECT_TRUE(tells(refusal(header("1") + leaf), {"inner node without children"}));
  EXPECT_TRUE(tells(refusal(header("1", "res 0.05\ndata\n", "binary ") + std::string(2, '\0')),
                    {"inner node without children"}));
  for (const float value :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    std::string node(5, '\0');
    std::memcpy(node.data(), &value, sizeof(value));
    node[4] = 1;
    EXPECT_TRUE(tells(refusal(header("2") + node + leaf), {"log-odds", "at byte"}));
  }
}

TEST_F(OctomapFile, HeadersThatSaySomethingElseAreRefused) {
  EXPECT_TRUE(tells(refusal(""), {"no OctoMap file"}));
  EXPECT_TRUE(tells(refusal("PNG"), {"no OctoMap file", "# Octomap OcTree file"}));
  EXPECT_TRUE(tells(refusal(header("0", "res 0.05\n")), {"no line \"data\""}));
  EXPECT_TRUE(tells(refusal(header("0", "data\n")), {"no line \"res\""}));
  EXPECT_TRUE(tells(refusal(header("0", "res nan\ndata\n")), {"map:5", "res is \"nan\""}));
  EXPECT_TRUE(tells(refusal(header("0", "res -0.05\ndata\n")), {"res is \"-0.05\""}));
  EXPECT_TRUE(tells(refusal(header("0", "res 0.1\ndata\n")), {"0.1 m", "0.05 m"}));
  EXPECT_TRUE(tells(refusal(header("0", "color red\ndata\n")), {"map:5", "\"color\""}));
  EXPECT_TRUE(tells(refusal(header("0", "res 0.05\ndata\n", "", "CountingOcTree")),
                    {"map:3", "CountingOcTree"}));
  EXPECT_TRUE(tells(refusal(header("0", std::string(100'000, '#'))), {"no line \"data\""}));
  EXPECT_TRUE(
      tells(sentenceOf([&] { (void)readOctomapHeader(folder_.path()); }), {"regular file"}));
  EXPECT_TRUE(tells(sentenceOf([&] { (void)readOctomapHeader(folder_.at("nowhere")); }),
                    {"does not exist"}));
}

}  // namespace
}  // namespace occusg
