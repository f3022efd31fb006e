// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/graph_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "occusg/error.hpp"
#include "tracked_squares.hpp"

namespace occusg {
namespace {

using testing::describe;
using testing::paperGraph;
using testing::poseAt;
using testing::rectangle;
using testing::regionFrom;
using testing::roomsOf;
using testing::squareAt;
using testing::tracked;

/// A world whose regions come, go, grow, merge and change ids as a bad day of a decomposer would
/// have it: up to six rectangles in a row, neighbours merged at random.
class RandomRegions {
 public:
  explicit RandomRegions(unsigned seed) : random_(seed) {}

  TrackedRegions next() {
    TrackedRegions regions;
    for (int x = 0; x < 6;) {
      const int width = chance(0.2) ? 2 : 1;
      const double left = 4.0 * x + jitter();
      const int id = idAt(x, width);
      if (chance(0.8)) {
        regions.decomposition.regions.push_back(
            regionFrom(id, rectangle(left, 0.0, left + 4.0 * width - 0.2, 4.0 + jitter())));
      } else if (chance(0.7)) {
        regions.missed.push_back(id);
      }
      x += width;
    }
    std::sort(regions.missed.begin(), regions.missed.end());
    addCrossings(regions.decomposition);
    regions.stale = chance(0.1);
    return regions;
  }
  Pose pose() { return poseAt(uniform(-2.0, 26.0), uniform(-1.0, 5.0)); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  double uniform(double low, double high) {
    // The standard distributions differ between libraries; the engine does not.
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }

 private:
  double jitter() { return chance(0.5) ? 0.0 : uniform(-0.1, 0.1); }
  int idAt(int x, int width) {
    int& id = ids_[static_cast<std::size_t>(2 * x + width - 1)];
    if (id == 0 || chance(0.1)) id = next_id_++;
    return id;
  }
  static void addCrossings(Decomposition& decomposition) {
    for (const Region& a : decomposition.regions) {
      for (const Region& b : decomposition.regions) {
        if (a.id < b.id && distance(a.centroid, b.centroid) < 6.5) {
          decomposition.crossings.push_back({a.id, b.id, {a.centroid, b.centroid}});
        }
      }
    }
  }

  std::mt19937 random_;
  std::vector<int> ids_ = std::vector<int>(12, 0);
  int next_id_ = 1;
};

void play(GraphBuilder& builder, unsigned seed, int updates) {
  RandomRegions world(seed);
  for (int i = 0; i < updates; ++i) {
    const TrackedRegions regions = world.next();
    if (world.chance(0.3)) {
      builder.mutableGraph().add({world.uniform(0.0, 24.0), world.uniform(0.0, 4.0), 0.5}, i,
                                 ObjectAttributes{"chair", 0.8});
    }
    builder.update(regions, world.pose(), i);
  }
  builder.finish(updates);
}

/// What must hold of any graph at any time.
void expectSound(const SceneGraph& graph) {
  std::set<int> regions;
  std::set<std::string> names;
  for (const NodeId id : roomsOf(graph)) {
    const RoomAttributes& room = graph.room(id);
    EXPECT_TRUE(regions.insert(room.region_id).second) << "two rooms on one region";
    EXPECT_TRUE(names.insert(room.name).second) << "two rooms of one name";
    EXPECT_TRUE(isSimple(room.polygon));
    EXPECT_GT(signedArea(room.polygon.outer), 0.0);
    EXPECT_NEAR(area(room.polygon), room.area_m2, 1e-9);
    const Node& node = graph.at(id);
    EXPECT_TRUE(contains(room.polygon, node.groundPosition()));
    EXPECT_LE(node.created_s, node.last_seen_s);
  }
  std::set<NodeId> members;
  for (const auto& [ends, edge] : graph.edges(EdgeType::kContains))
    EXPECT_TRUE(members.insert(ends.second).second) << "a member of two rooms";
}

TEST(GraphBuilder, AndRow22EveryRegionHasAtMostOneRoomAndEveryRoomAPolygon) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    GraphBuilder builder(seed % 2 == 0 ? paperGraph() : GraphBuilderConfig{});
    RandomRegions world(seed);
    std::size_t most_rooms = 0;
    for (int i = 0; i < 60; ++i) {
      const TrackedRegions regions = world.next();
      if (world.chance(0.3))
        builder.mutableGraph().add({world.uniform(0.0, 24.0), 1.0, 0.5}, i, ObjectAttributes{});
      expectSound(builder.update(regions, world.pose(), i));
      most_rooms = std::max(most_rooms, roomsOf(builder.graph()).size());
    }
    expectSound(builder.finish(60.0));
    EXPECT_GE(most_rooms, 3U) << "the sequence tests nothing";
    if (HasFailure()) return;
  }
}

TEST(GraphBuilder, EqualInputGivesEqualGraphs) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    GraphBuilder one{GraphBuilderConfig{}};
    GraphBuilder other{GraphBuilderConfig{}};
    play(one, seed, 50);
    play(other, seed, 50);
    EXPECT_EQ(describe(one.graph()), describe(other.graph()));
  }
}

TEST(GraphBuilder, TheOrderOfRegionsAndCrossingsDoesNotMatter) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    GraphBuilder one(paperGraph());
    GraphBuilder other(paperGraph());
    RandomRegions world(seed);
    for (int i = 0; i < 50; ++i) {
      TrackedRegions regions = world.next();
      const Pose pose = world.pose();
      one.update(regions, pose, i);
      std::reverse(regions.decomposition.regions.begin(), regions.decomposition.regions.end());
      std::reverse(regions.decomposition.crossings.begin(), regions.decomposition.crossings.end());
      other.update(regions, pose, i);
      ASSERT_EQ(describe(one.graph()), describe(other.graph())) << "update " << i;
    }
  }
}

TEST(GraphBuilder, TheOrderOfObjectsDoesNotChangeTheRooms) {
  const std::vector<double> positions{2.0, 6.0, 10.0, 14.0};
  const auto regions =
      tracked({squareAt(1, 0.0), squareAt(2, 4.0), squareAt(3, 8.0), squareAt(4, 12.0)});
  std::vector<std::string> results;
  for (const auto& order : {positions, {positions.rbegin(), positions.rend()}}) {
    GraphBuilder builder(paperGraph());
    for (const double x : order) builder.mutableGraph().add({x, 2.0, 0.0}, 0.0, ObjectAttributes{});
    for (int i = 0; i < 4; ++i) builder.update(regions, poseAt(2.0, 2.0), i);
    std::string result;
    for (const NodeId room : roomsOf(builder.graph())) {
      result += std::to_string(room) + " on " +
                std::to_string(builder.graph().room(room).region_id) + " holds";
      for (const NodeId member : builder.graph().targets(EdgeType::kContains, room))
        result += " x=" + std::to_string(builder.graph().at(member).position.x());
    }
    results.push_back(result);
  }
  ASSERT_EQ(results.size(), 2U);
  EXPECT_NE(results[0].find("4000003 on 4 holds x=14"), std::string::npos) << results[0];
  EXPECT_EQ(results[0], results[1]);
}

TEST(GraphBuilder, ResetForgetsEverything) {
  GraphBuilder fresh{GraphBuilderConfig{}};
  GraphBuilder used{GraphBuilderConfig{}};
  play(used, 3, 20);
  used.reset();
  EXPECT_EQ(used.graph().nodeCount(), 0U);
  play(used, 4, 30);
  play(fresh, 4, 30);
  EXPECT_EQ(describe(used.graph()), describe(fresh.graph()));
}

TEST(GraphBuilder, MaintainsOncePerPeriodOfTheStampsItIsGiven) {
  GraphBuilder builder(paperGraph());
  builder.mutableGraph().add({12.0, 2.0, 0.0}, 0.0, ObjectAttributes{});
  auto regions = tracked({squareAt(1, 0.0), squareAt(2, 10.0)});
  // Stamps of this century in steps of a tenth: the twentieth must count as two seconds.
  for (int i = 0; i <= 40; ++i) {
    builder.update(regions, poseAt(2.0, 2.0), 1.7e9 + 0.1 * i);
    const std::size_t expected = i < 20 ? 1U : i < 40 ? 2U : 3U;
    ASSERT_EQ(roomsOf(builder.graph()).size(), expected) << i;
    if (i == 20) {
      builder.mutableGraph().add({22.0, 2.0, 0.0}, 0.0, ObjectAttributes{});
      regions.decomposition.regions.push_back(squareAt(3, 20.0));
    }
  }
}

TEST(GraphBuilder, PosesBetweenUpdatesBecomeAgents) {
  GraphBuilder builder{GraphBuilderConfig{}};
  builder.update(tracked({squareAt(1, 0.0)}), poseAt(0.5, 2.0), 0.0);
  builder.observePose(poseAt(1.0, 2.0), 0.2);
  builder.observePose(poseAt(1.5, 2.0), 0.4);
  EXPECT_EQ(builder.graph().nodes(NodeType::kAgent).size(), 3U);
  builder.update(tracked({squareAt(1, 0.0)}), poseAt(1.6, 2.0), 1.0);
  EXPECT_EQ(builder.graph().targets(EdgeType::kContains, *builder.currentRoom()),
            (std::vector<NodeId>{0, 1, 2}));
}

TEST(GraphBuilder, AnAgentOutsideEveryRegionIsANodeInNoRoom) {
  GraphBuilder builder{GraphBuilderConfig{}};
  const auto regions = tracked({squareAt(1, 0.0)});
  builder.update(regions, poseAt(2.0, 2.0), 0.0);
  builder.update(regions, poseAt(500.0, -500.0), 1.0);
  const SceneGraph& graph = builder.finish(2.0);
  ASSERT_EQ(graph.nodes(NodeType::kAgent).size(), 2U);
  EXPECT_TRUE(graph.roomOf(0));
  EXPECT_FALSE(graph.roomOf(1));
  EXPECT_EQ(graph.edges(EdgeType::kTemporal).size(), 1U);
  EXPECT_EQ(roomsOf(graph).size(), 1U);
  EXPECT_FALSE(builder.currentRoom());
}

TEST(GraphBuilder, AnUpdateBackInTimeIsRefusedAndCounted) {
  GraphBuilder builder{GraphBuilderConfig{}};
  builder.update(tracked({squareAt(1, 0.0)}), poseAt(2.0, 2.0), 10.0);
  const std::string before = describe(builder.graph());
  builder.update(tracked({squareAt(2, 50.0)}), poseAt(52.0, 2.0), 9.0);
  EXPECT_EQ(describe(builder.graph()), before);
  EXPECT_EQ(builder.updatesBackInTime(), 1U);
  EXPECT_EQ(builder.posesBackInTime(), 1U);
}

TEST(GraphBuilder, APoseOrStampThatIsNotFiniteLeavesTheGraphAsItWas) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  GraphBuilder builder{GraphBuilderConfig{}};
  const auto regions = tracked({squareAt(1, 0.0)});
  builder.update(regions, poseAt(2.0, 2.0), 0.0);
  const std::string before = describe(builder.graph());
  EXPECT_THROW(builder.update(regions, poseAt(nan, 2.0), 1.0), Error);
  EXPECT_THROW(builder.update(regions, poseAt(2.0, infinity), 1.0), Error);
  EXPECT_THROW(builder.update(regions, poseAt(2.0, 2.0), nan), Error);
  EXPECT_THROW(builder.observePose(poseAt(2.0, 2.0), infinity), Error);
  EXPECT_THROW(builder.finish(nan), Error);
  EXPECT_EQ(describe(builder.graph()), before);
}

TEST(GraphBuilder, FinishWithoutAnyUpdateGivesAnEmptyGraph) {
  GraphBuilder builder{GraphBuilderConfig{}};
  EXPECT_EQ(builder.finish(1.0).nodeCount(), 0U);
}

}  // namespace
}  // namespace occusg
