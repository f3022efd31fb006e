// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/far_islands.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "occusg/geometry/cell.hpp"
#include "occusg/mapping/free_space_layer.hpp"

namespace occusg {
namespace {

/// Squares of 64 x 64 columns in which something is known; a part is what joins side or corner.
constexpr unsigned kSquareLevels = 6;
constexpr int kSquareSide = 1 << kSquareLevels;
static_assert(kSquareSide == kLayerBoxStep_cells, "the layer's box is made of whole squares");
/// Squares along the longest side a layer can have; a node that fills more is no island.
constexpr int kTooLarge_squares = 128;

using Squares = std::set<std::pair<int, int>>;

struct Island {
  std::vector<std::pair<int, int>> squares;
  CellBox box;  ///< In squares.
};

/// A node of the tree and where it is.
struct Place {
  octomap::OcTreeNode* node = nullptr;
  unsigned level = 0;  ///< Its side is 2^level voxels.
  int x = 0;           ///< Lowest square it is in.
  int y = 0;

  [[nodiscard]] int side() const {
    return level > kSquareLevels ? 1 << (level - kSquareLevels) : 1;
  }
  [[nodiscard]] Place child(const octomap::OcTree& tree, unsigned index) const {
    const int half = level > kSquareLevels ? side() / 2 : 0;
    return {tree.getNodeChild(node, index), level - 1, x + half * static_cast<int>(index & 1U),
            y + half * static_cast<int>((index >> 1U) & 1U)};
  }
};

bool isBlock(const octomap::OcTree& tree, const Place& place) {
  return place.level <= kSquareLevels || !tree.nodeHasChildren(place.node);
}

/// @return false when a node is too large for a layer: cutting off others would not help.
bool addSquares(const octomap::OcTree& tree, const Place& place, Squares& squares) {
  if (!isBlock(tree, place)) {
    for (unsigned i = 0; i < 8; ++i) {
      if (tree.nodeChildExists(place.node, i) && !addSquares(tree, place.child(tree, i), squares))
        return false;
    }
    return true;
  }
  if (place.side() > kTooLarge_squares) return false;
  for (int dy = 0; dy < place.side(); ++dy)
    for (int dx = 0; dx < place.side(); ++dx) squares.insert({place.x + dx, place.y + dy});
  return true;
}

/// Makes a leaf of a node. The tree deletes leaves alone; what it prunes is a leaf afterwards.
void makeLeaf(octomap::OcTree& tree, octomap::OcTreeNode* node) {
  for (unsigned i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(node, i) && tree.nodeHasChildren(tree.getNodeChild(node, i)))
      makeLeaf(tree, tree.getNodeChild(node, i));
  }
  for (unsigned i = 0; i < 8; ++i) {
    if (!tree.nodeChildExists(node, i)) tree.createNodeChild(node, i);
    tree.getNodeChild(node, i)->setLogOdds(0.0F);
  }
  tree.pruneNode(node);
}

/// Removes what is below a place and in one of the squares.
/// @return whether nothing is left: the node is a leaf then, to be deleted.
bool removeSquares(octomap::OcTree& tree, const Place& place, const Squares& squares) {
  if (isBlock(tree, place)) {
    if (squares.count({place.x, place.y}) == 0) return false;
    if (tree.nodeHasChildren(place.node)) makeLeaf(tree, place.node);
    return true;
  }
  for (unsigned i = 0; i < 8; ++i) {
    if (tree.nodeChildExists(place.node, i) && removeSquares(tree, place.child(tree, i), squares))
      tree.deleteNodeChild(place.node, i);
  }
  if (tree.nodeHasChildren(place.node)) return false;
  makeLeaf(tree, place.node);
  return true;
}

bool fitsALayer(const CellBox& squares) {
  const auto cells = static_cast<std::size_t>(squares.width()) *
                     static_cast<std::size_t>(squares.height()) * kSquareSide * kSquareSide;
  return cells <= kMaxLayerCells;
}

CellBox boundsOf(const Squares& squares) {
  CellBox box;
  for (const auto& [x, y] : squares) box = box.including(Cell{x, y});
  return box;
}

Island islandFrom(std::pair<int, int> start, Squares& left) {
  Island island;
  island.squares.push_back(start);
  left.erase(start);
  for (std::size_t i = 0; i < island.squares.size(); ++i) {
    const auto [x, y] = island.squares[i];
    island.box = island.box.including(Cell{x, y});
    for (int step = 0; step < 9; ++step) {
      const std::pair<int, int> beside{x + step % 3 - 1, y + step / 3 - 1};
      if (left.erase(beside) > 0) island.squares.push_back(beside);
    }
  }
  return island;
}

/// The largest first.
std::vector<Island> islandsOf(Squares left) {
  std::vector<Island> islands;
  while (!left.empty()) islands.push_back(islandFrom(*left.begin(), left));
  std::stable_sort(islands.begin(), islands.end(), [](const Island& a, const Island& b) {
    return a.squares.size() > b.squares.size();
  });
  return islands;
}

/// Largest distance between two boxes along an axis, in squares.
int gapBetween(const CellBox& a, const CellBox& b) {
  return std::max({a.min.x - b.max.x, b.min.x - a.max.x, a.min.y - b.max.y, b.min.y - a.max.y, 0});
}

}  // namespace

FarIslands removeFarIslands(octomap::OcTree& tree) {
  FarIslands cut;
  if (tree.getRoot() == nullptr || !tree.nodeHasChildren(tree.getRoot())) return cut;
  const Place root{tree.getRoot(), tree.getTreeDepth(), 0, 0};
  Squares squares;
  if (!addSquares(tree, root, squares) || fitsALayer(boundsOf(squares))) return cut;

  const std::size_t nodes_before = tree.size();
  Squares removed;
  CellBox kept;
  for (const Island& island : islandsOf(squares)) {
    const CellBox with = kept.including(island.box);
    if (kept.empty() || fitsALayer(with)) {
      kept = with;
      continue;
    }
    ++cut.islands;
    cut.farthest_m =
        std::max(cut.farthest_m, gapBetween(island.box, kept) * kSquareSide * tree.getResolution());
    removed.insert(island.squares.begin(), island.squares.end());
  }
  if (cut.islands > 0) (void)removeSquares(tree, root, removed);
  cut.nodes = nodes_before - tree.size();
  return cut;
}

std::string sentenceOn(const FarIslands& cut) {
  return std::to_string(cut.islands) + (cut.islands == 1 ? " island (" : " islands (") +
         std::to_string(cut.nodes) + " nodes, up to " +
         std::to_string(std::lround(cut.farthest_m)) +
         " m away) cut off: the map spanned more than a free-space layer can; a pose must have "
         "jumped";
}

}  // namespace occusg
