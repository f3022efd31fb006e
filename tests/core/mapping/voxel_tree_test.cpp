// SPDX-License-Identifier: BSD-3-Clause
// Whole frames written to the tree, against OctoMap's own update of one voxel after another.
#include "mapping/voxel_tree.hpp"

#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "map_difference.hpp"
#include "mapping/frame_voxels.hpp"
#include "mapping/settled_voxels.hpp"
#include "mapping/workers.hpp"
#include "occusg/mapping/occupancy_map.hpp"

namespace occusg {
namespace {

constexpr int kBlocksASide = 6;
constexpr int kFrames = 20;

/// A voxel's key and its word and bit in a block, in Morton order.
octomap::OcTreeKey keyOf(std::uint64_t code, unsigned word, unsigned bit) {
  octomap::OcTreeKey key(0, 0, 0);
  const std::uint64_t path = code << 9 | word << 6 | bit;
  for (unsigned level = 0; level < 16; ++level)
    for (unsigned axis = 0; axis < 3; ++axis)
      key[axis] =
          static_cast<octomap::key_type>(key[axis] | (path >> (3 * level + axis) & 1U) << level);
  return key;
}

/// Words of a block: whole, empty or scattered marks, as frames have.
std::uint64_t randomWord(std::mt19937& random) {
  const std::uint64_t scattered =
      (static_cast<std::uint64_t>(random()) << 32 | random()) & random() * 0x100000001U;
  const std::uint64_t choices[] = {0, ~std::uint64_t{0}, scattered};
  return choices[random() % 3];
}

/// Every block is seen free again and again, and hit now and then, so that voxels reach both clamps
/// and leave them, and nodes are pruned and expanded on all levels.
std::vector<VoxelBlock> randomFrame(std::mt19937& random) {
  FrameVoxels places;
  for (int x = 0; x < kBlocksASide; ++x)
    for (int y = 0; y < kBlocksASide; ++y)
      for (int z = 0; z < kBlocksASide; ++z)
        if (random() % 3 != 0)
          places.markFree(octomap::OcTreeKey(
              static_cast<octomap::key_type>(kZeroKey + kBlockSide * (x - kBlocksASide / 2)),
              static_cast<octomap::key_type>(kZeroKey + kBlockSide * (y - kBlocksASide / 2)),
              static_cast<octomap::key_type>(kZeroKey + kBlockSide * (z - kBlocksASide / 2))));
  std::vector<VoxelBlock> blocks = places.settled();
  for (VoxelBlock& block : blocks) {
    const bool is_free_frame = random() % 4 != 0;
    for (unsigned i = 0; i < 8; ++i) {
      const std::uint64_t marks = randomWord(random);
      const std::uint64_t hits = is_free_frame ? 0 : randomWord(random);
      block.free[i] = (random() % 2 != 0 ? ~std::uint64_t{0} : marks) & ~hits;
      block.occupied[i] = hits;
    }
    block.free[0] |= ~block.occupied[0];  // no block without a mark
  }
  return blocks;
}

void updateOneByOne(const std::vector<VoxelBlock>& blocks, octomap::OcTree& tree) {
  for (const VoxelBlock& block : blocks)
    for (unsigned word = 0; word < 8; ++word)
      for (unsigned bit = 0; bit < 64; ++bit) {
        const bool is_free = (block.free[word] >> bit & 1U) != 0;
        const bool is_occupied = (block.occupied[word] >> bit & 1U) != 0;
        if (is_free || is_occupied)
          (void)tree.updateNode(keyOf(block.code, word, bit), is_occupied);
      }
}

/// Voxels listed as settled that are not at their clamp.
std::size_t wronglySettled(const std::vector<VoxelBlock>& blocks, const SettledVoxels& settled,
                           const octomap::OcTree& tree) {
  std::size_t wrong = 0;
  for (const VoxelBlock& block : blocks) {
    const SettledBlock& listed = settled.of(block.code);
    for (unsigned word = 0; word < 8; ++word)
      for (unsigned bit = 0; bit < 64; ++bit) {
        const bool is_free = (listed.free[word] >> bit & 1U) != 0;
        const bool is_occupied = (listed.occupied[word] >> bit & 1U) != 0;
        if (!is_free && !is_occupied) continue;
        const octomap::OcTreeNode* node = tree.search(keyOf(block.code, word, bit));
        const bool holds = node != nullptr && is_free != is_occupied &&
                           (is_free ? node->getLogOdds() <= tree.getClampingThresMinLog()
                                    : node->getLogOdds() >= tree.getClampingThresMaxLog());
        wrong += holds ? 0 : 1;
      }
  }
  return wrong;
}

std::size_t countSettled(const std::vector<VoxelBlock>& blocks, const SettledVoxels& settled) {
  std::size_t words = 0;
  for (const VoxelBlock& block : blocks)
    for (unsigned i = 0; i < 8; ++i)
      words += (settled.of(block.code).free[i] | settled.of(block.code).occupied[i]) != 0 ? 1 : 0;
  return words;
}

/// With the probabilities of the map.
void configure(octomap::OcTree& tree) {
  const octomap::OcTree like = testing::emptyTreeLike(OccupancyMapConfig{});
  tree.setProbHit(like.getProbHit());
  tree.setProbMiss(like.getProbMiss());
  tree.setClampingThresMin(like.getClampingThresMin());
  tree.setClampingThresMax(like.getClampingThresMax());
}

class VoxelTreeOverThreads : public ::testing::TestWithParam<int> {};

TEST_P(VoxelTreeOverThreads, EqualsOneUpdateAVoxelNodeByNode) {
  constexpr unsigned kSeed = 7;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  octomap::OcTree expected = testing::emptyTreeLike(OccupancyMapConfig{});
  VoxelTree tree(expected.getResolution());
  configure(tree);
  SettledVoxels settled;
  Workers workers(GetParam());
  std::size_t settled_words = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const std::vector<VoxelBlock> blocks = randomFrame(random);
    updateOneByOne(blocks, expected);
    (void)tree.integrate(blocks, settled, workers);
    ASSERT_TRUE(tree == expected) << "frame " << frame;
    ASSERT_EQ(tree.size(), tree.calcNumNodes());
    ASSERT_EQ(wronglySettled(blocks, settled, tree), 0U);
    settled_words = std::max(settled_words, countSettled(blocks, settled));
  }
  EXPECT_GT(settled_words, 500U) << "the frames are meant to bring voxels to their clamps";
  EXPECT_TRUE(tree.columns() == VoxelColumns::of(expected));
}

INSTANTIATE_TEST_SUITE_P(Threads, VoxelTreeOverThreads, ::testing::Values(1, 2, 5));

TEST(VoxelTree, NamesTheSameChangedColumnsWithAnyNumberOfThreads) {
  std::vector<std::vector<std::vector<Cell>>> changes;
  for (const int threads : {1, 2, 5}) {
    std::mt19937 random(11);
    VoxelTree tree(0.05);
    configure(tree);
    SettledVoxels settled;
    Workers workers(threads);
    changes.emplace_back();
    for (int frame = 0; frame < kFrames; ++frame)
      changes.back().push_back(tree.integrate(randomFrame(random), settled, workers));
  }
  EXPECT_EQ(changes[1], changes[0]);
  EXPECT_EQ(changes[2], changes[0]);
}

}  // namespace
}  // namespace occusg
