// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/far_islands.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "occusg/mapping/free_space_layer.hpp"
#include "voxel_scenes.hpp"

namespace occusg {
namespace {

constexpr double kResolution_m = 0.05;

/// Squares of `side` voxels, each at a corner given in metres.
struct Patch {
  double x_m = 0.0;
  double y_m = 0.0;
  int side = 1;
};

std::unique_ptr<octomap::OcTree> treeOf(const std::vector<Patch>& patches) {
  auto tree = std::make_unique<octomap::OcTree>(kResolution_m);
  for (const Patch& patch : patches) {
    for (int i = 0; i < patch.side * patch.side; ++i) {
      const octomap::point3d at(
          static_cast<float>(patch.x_m + (i % patch.side + 0.5) * kResolution_m),
          static_cast<float>(patch.y_m + (i / patch.side + 0.5) * kResolution_m), 0.02F);
      tree->updateNode(at, true);
    }
  }
  return tree;
}

bool isKnown(const octomap::OcTree& tree, double x_m, double y_m) {
  return tree.search(x_m + 0.02, y_m + 0.02, 0.02) != nullptr;
}

TEST(FarIslands, MapThatFitsIsUntouched) {
  const auto tree = treeOf({{0.0, 0.0, 20}, {300.0, 300.0, 5}});
  const std::size_t nodes = tree->size();
  EXPECT_TRUE(removeFarIslands(*tree).none());
  EXPECT_EQ(tree->size(), nodes);
}

TEST(FarIslands, WhatAPoseThatJumpedLeftIsCutOffAndCounted) {
  const auto tree = treeOf({{0.0, 0.0, 200}, {900.0, 900.0, 10}});
  const std::size_t nodes = tree->size();
  const FarIslands cut = removeFarIslands(*tree);
  EXPECT_EQ(cut.islands, 1U);
  EXPECT_EQ(cut.nodes, nodes - tree->size());
  EXPECT_NEAR(cut.farthest_m, 890.0, 7.0);
  EXPECT_TRUE(isKnown(*tree, 0.0, 0.0));
  EXPECT_TRUE(isKnown(*tree, 9.95, 9.95));
  EXPECT_FALSE(isKnown(*tree, 900.0, 900.0));
  EXPECT_EQ(sentenceOn(cut).rfind("1 island (", 0), 0U);
}

TEST(FarIslands, IslandNearEnoughStaysAlthoughAnotherGoes) {
  const auto tree = treeOf({{0.0, 0.0, 200}, {-900.0, 900.0, 3}, {100.0, 0.0, 80}});
  EXPECT_EQ(removeFarIslands(*tree).islands, 1U);
  EXPECT_TRUE(isKnown(*tree, 100.0, 0.0));
  EXPECT_FALSE(isKnown(*tree, -900.0, 900.0));
}

TEST(FarIslands, MapMadeOfATreeWithOneCanBeProjected) {
  OccupancyMapConfig config;
  config.resolution_m = kResolution_m;
  const OccupancyMap map(config, treeOf({{0.0, 0.0, 200}, {900.0, 900.0, 10}}));
  EXPECT_EQ(map.cutIslands().islands, 1U);
  FreeSpaceLayer layer(FreeSpaceLayerConfig{}, GridFrame{kResolution_m});
  EXPECT_NO_THROW(layer.recompute(map));
}

}  // namespace
}  // namespace occusg
