// SPDX-License-Identifier: BSD-3-Clause
#include "graph/navigation_layer.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "occusg/error.hpp"

namespace occusg {
namespace {

/// A painted layer, given to a navigation layer as it changes.
class PaintedFloor {
 public:
  explicit PaintedFloor(const NavigationLayerConfig& config) : navigation_(config, 0.0) {
    layer_.frame.resolution_m = 0.05;
    layer_.cells = FreeSpaceCells({{-60, -60}, {60, 60}}, kUnknown);
  }

  /// Paints [x0, x1) x [y0, y1).
  void paint(int x0, int y0, int x1, int y1, std::int8_t value = kFree) {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) layer_.cells.at({x, y}) = value;
    changed_ = changed_.including(CellBox{{x0, y0}, {x1, y1}});
  }
  void update() { navigation_.update(graph_, layer_, std::exchange(changed_, CellBox{}), 1.0); }

  [[nodiscard]] std::vector<NodeId> nodes() const {
    std::vector<NodeId> ids;
    for (const auto& [id, node] : graph_.nodes(NodeType::kNavigation)) ids.push_back(id);
    return ids;
  }
  [[nodiscard]] std::size_t edgeCount() const {
    return graph_.edges(EdgeType::kTraversable).size();
  }
  [[nodiscard]] const NavigationAttributes& at(NodeId id) const {
    return std::get<NavigationAttributes>(graph_.at(id).attributes);
  }
  [[nodiscard]] const SceneGraph& graph() const { return graph_; }
  [[nodiscard]] const NavigationLayer& navigation() const { return navigation_; }
  [[nodiscard]] const FreeSpace& layer() const { return layer_; }

 private:
  NavigationLayer navigation_;
  FreeSpace layer_;
  CellBox changed_;
  SceneGraph graph_;
};

/// Edges whose straight line leads over a cell that is not free.
std::size_t edgesOverClosedCells(const PaintedFloor& floor) {
  std::size_t count = 0;
  for (const auto& [key, edge] : floor.graph().edges(EdgeType::kTraversable)) {
    const Point2 a = floor.graph().at(edge.source).groundPosition();
    const Point2 b = floor.graph().at(edge.target).groundPosition();
    for (int k = 0; k <= 100; ++k) {
      const Point2 at{a.x + k * (b.x - a.x) / 100.0, a.y + k * (b.y - a.y) / 100.0};
      if (floor.layer().cells.valueOr(floor.layer().frame.cellAt(at), kUnknown) == kFree) continue;
      ++count;
      break;
    }
  }
  return count;
}

NavigationLayerConfig paperNavigation() { return {15, 25, 0, NavigationNodes::kOnePerBlock}; }

TEST(NavigationLayer, ABlockNeedsTwentyFiveFreeCells) {
  PaintedFloor floor(paperNavigation());
  floor.paint(0, 0, 4, 6);  // 24 cells
  floor.update();
  EXPECT_TRUE(floor.nodes().empty());
  floor.paint(4, 0, 5, 1);  // 25
  floor.update();
  ASSERT_EQ(floor.nodes().size(), 1U);
  EXPECT_EQ(floor.at(floor.nodes()[0]).free_cells, 25);
  EXPECT_NEAR(floor.graph().at(floor.nodes()[0]).position.x(), 0.375, 1e-12);
}

TEST(NavigationLayer, BlocksAreAlignedToWorldZeroAndEightConnected) {
  PaintedFloor floor(paperNavigation());
  floor.paint(-30, -15, 30, 15);  // 4 x 2 blocks
  floor.update();
  ASSERT_EQ(floor.nodes().size(), 8U);
  // 6 across columns, 4 across rows, 2 diagonals in each of 3 squares.
  EXPECT_EQ(floor.edgeCount(), 6U + 4U + 6U);
  std::set<std::pair<int, int>> blocks;
  for (const NodeId id : floor.nodes()) blocks.emplace(floor.at(id).block.x, floor.at(id).block.y);
  EXPECT_EQ(blocks.count({-2, -1}), 1U);
  EXPECT_EQ(blocks.count({1, 0}), 1U);
}

TEST(NavigationLayer, DiagonalBlocksAreJoinedOnlyThroughFreeCellsOfTheirOwn) {
  PaintedFloor floor(paperNavigation());
  floor.paint(5, 5, 15, 15);
  floor.paint(15, 15, 25, 25);  // touches the first in a corner
  floor.update();
  ASSERT_EQ(floor.nodes().size(), 2U);
  EXPECT_EQ(floor.edgeCount(), 1U);
  floor.paint(14, 14, 15, 15, kFullObstacle);
  floor.update();
  EXPECT_EQ(floor.edgeCount(), 0U);
}

TEST(NavigationLayer, AStepPastACornerNeedsTheCellsBesideItFree) {
  PaintedFloor floor(NavigationLayerConfig{});
  floor.paint(5, 5, 15, 15);
  floor.paint(15, 15, 25, 25);
  floor.update();
  ASSERT_EQ(floor.nodes().size(), 2U);
  EXPECT_EQ(floor.edgeCount(), 0U) << "it would cut the corner of two obstacles";
  floor.paint(15, 14, 16, 15);
  floor.update();
  EXPECT_EQ(floor.edgeCount(), 0U) << "of one";
  floor.paint(14, 15, 15, 16);
  floor.update();
  EXPECT_EQ(floor.edgeCount(), 1U);
  floor.paint(14, 15, 15, 16, kFullObstacle);
  floor.update();
  EXPECT_EQ(floor.edgeCount(), 0U);
}

TEST(NavigationLayer, NodesStandOnFreeCellsOnBothSidesOfAWall) {
  PaintedFloor floor(NavigationLayerConfig{});
  floor.paint(0, 0, 15, 15);
  floor.paint(7, 0, 9, 15, kFullObstacle);
  floor.update();
  ASSERT_EQ(floor.nodes().size(), 2U);
  EXPECT_EQ(floor.edgeCount(), 0U);
  for (const NodeId id : floor.nodes()) {
    const Cell cell = floor.layer().frame.cellAt(floor.graph().at(id).groundPosition());
    EXPECT_EQ(floor.layer().cells.at(cell), kFree);
  }
}

TEST(NavigationLayer, ANodeIsRemovedWithHysteresis) {
  PaintedFloor floor({15, 25, 15, NavigationNodes::kOnePerPart});
  floor.paint(0, 0, 5, 5);
  floor.update();
  ASSERT_EQ(floor.nodes().size(), 1U);
  const NodeId node = floor.nodes()[0];
  floor.paint(0, 0, 5, 2, kFullObstacle);  // 15 left
  floor.update();
  EXPECT_EQ(floor.nodes(), std::vector<NodeId>{node});
  floor.paint(0, 2, 1, 3, kFullObstacle);  // 14
  floor.update();
  EXPECT_TRUE(floor.nodes().empty());
  floor.paint(0, 0, 5, 4);
  floor.paint(0, 4, 1, 5, kFullObstacle);  // 24 again
  floor.update();
  EXPECT_TRUE(floor.nodes().empty()) << "20 cells make no new node";
}

TEST(NavigationLayer, PaperKeepsANodeWhateverBecomesOfItsBlock) {
  PaintedFloor floor(paperNavigation());
  floor.paint(0, 0, 15, 15);
  floor.update();
  floor.paint(0, 0, 15, 15, kFullObstacle);
  floor.update();
  ASSERT_EQ(floor.nodes().size(), 1U);
  EXPECT_EQ(floor.at(floor.nodes()[0]).free_cells, 0);
}

TEST(NavigationLayer, OnlyBlocksThatChangedAreTouched) {
  PaintedFloor floor(NavigationLayerConfig{});
  floor.paint(-60, -60, 60, 60);
  floor.update();
  EXPECT_EQ(floor.navigation().changedBlocks(), 64U);
  const Revision before = floor.graph().revision();
  floor.paint(-60, -60, 60, 60);
  floor.update();
  EXPECT_EQ(floor.navigation().changedBlocks(), 0U);
  EXPECT_EQ(floor.graph().revision(), before);
  floor.paint(3, 3, 4, 4, kFullObstacle);
  floor.update();
  EXPECT_EQ(floor.navigation().changedBlocks(), 1U);
}

TEST(NavigationLayer, AnEdgeNeedsAStraightLineOfFreeCells) {
  PaintedFloor floor(NavigationLayerConfig{});
  floor.paint(0, 0, 30, 15);
  floor.update();
  EXPECT_EQ(floor.edgeCount(), 1U);
  floor.paint(13, 3, 17, 12, kFullObstacle);  // between the two middles; free above and below it
  floor.update();
  EXPECT_EQ(floor.nodes().size(), 2U);
  EXPECT_EQ(floor.edgeCount(), 0U);
  floor.paint(13, 3, 17, 12);
  floor.update();
  EXPECT_EQ(floor.edgeCount(), 1U);
}

TEST(NavigationLayer, UpdatesInPiecesGiveTheEdgesOfOneUpdate) {
  for (const auto& config : {NavigationLayerConfig{15, 25, 25, NavigationNodes::kOnePerPart},
                             NavigationLayerConfig{15, 25, 25, NavigationNodes::kOnePerBlock}}) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      std::mt19937 random(seed);
      PaintedFloor pieces(config);
      PaintedFloor whole(config);
      for (int i = 0; i < 60; ++i) {
        const int x = static_cast<int>(random() % 100U) - 60;
        const int y = static_cast<int>(random() % 100U) - 60;
        const int side = 1 + static_cast<int>(random() % 20U);
        const std::int8_t value = random() % 3U == 0U ? kFullObstacle : kFree;
        pieces.paint(x, y, x + side, y + side, value);
        whole.paint(x, y, x + side, y + side, value);
        pieces.update();
      }
      whole.update();
      EXPECT_EQ(pieces.nodes().size(), whole.nodes().size());
      if (config.nodes == NavigationNodes::kOnePerBlock)
        EXPECT_EQ(pieces.edgeCount(), whole.edgeCount());
      else  // nodes that stayed where they were see other nodes than new ones do
        EXPECT_EQ(edgesOverClosedCells(pieces) + edgesOverClosedCells(whole), 0U);
    }
  }
}

TEST(NavigationLayer, RefusesAConfigurationThatMakesNoSense) {
  EXPECT_THROW(NavigationLayer({1, 25, 0, NavigationNodes::kOnePerPart}, 0.0), Error);
  EXPECT_THROW(NavigationLayer({15, 0, 0, NavigationNodes::kOnePerPart}, 0.0), Error);
  EXPECT_THROW(NavigationLayer({15, 25, 26, NavigationNodes::kOnePerPart}, 0.0), Error);
}

}  // namespace
}  // namespace occusg
