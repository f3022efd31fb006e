// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/frame_voxels.hpp"
#include "mapping/settled_voxels.hpp"
#include "mapping/voxel_columns.hpp"

namespace occusg {

/// Writes a frame's marks to the nodes of an octree. It owns no nodes itself: it is an
/// `octomap::OcTree` for that class's calls on nodes, and because they count nodes in the tree they
/// are called on. So several writers can work on one tree, each below nodes of its own, and what
/// they count is added up afterwards.
class TreeWriter final : public octomap::OcTree {
 public:
  using Node = octomap::OcTreeNode;

  enum class Age { kOld, kNew };

  /// A node on the way down, and whether this frame made it.
  struct Place {
    Node* node = nullptr;
    Age age = Age::kOld;
  };

  /// One block of a frame on its way into the tree, and what becomes of it there.
  struct Update {
    const VoxelBlock* block = nullptr;
    SettledBlock* settled = nullptr;
    Place place;  ///< Its node; none when a leaf above it stays as it is.
    BlockChange change;
  };

  /// Some updates in Morton order.
  struct Updates {
    Update* first = nullptr;
    Update* last = nullptr;
  };

  /// @param tree to write to: its probabilities and clamps are taken.
  explicit TreeWriter(const octomap::OcTree& tree);

  /// Opens the nodes from the root down to those of blocks, below which each writer can go on
  /// alone.
  void open(const Place& root_node, const Updates& updates);
  /// Writes what lies below the nodes of blocks.
  void write(const Updates& updates);
  /// Brings the nodes above blocks up to date, after all blocks are written.
  void close();

  /// By how many nodes the tree has grown through this writer, modulo 2^64.
  [[nodiscard]] std::size_t takeGrowth();

 private:
  /// Marks of the voxels below one node, from the lowest bit.
  struct Marks {
    std::uint64_t free = 0;
    std::uint64_t occupied = 0;
  };

  /// Marked voxels below one node, from the lowest bit.
  struct Outcome {
    std::uint64_t free = 0;      ///< Became free.
    std::uint64_t occupied = 0;  ///< Became occupied.
    std::uint64_t settled = 0;   ///< Another update of the same kind would leave them as they are.
  };

  void openBelow(const Place& place, unsigned depth, const Updates& updates);
  [[nodiscard]] bool skips(const Place& place, const Updates& updates) const;

  void writeBlock(Update& update);
  Outcome writeBelow(const Place& place, unsigned voxels, const Marks& marks);
  Outcome writeVoxels(const Place& place, const Marks& marks);
  Outcome writeLeaf(const Place& place, std::uint64_t all, const Marks& marks);

  [[nodiscard]] Place child(const Place& parent, unsigned index);
  [[nodiscard]] bool isLeaf(const Place& place) const;
  [[nodiscard]] bool ignores(const Place& place, const Marks& marks) const;
  void readAhead(const Update* update, const Update* last);
  [[nodiscard]] float readChildren(const Node* node) const;
  [[nodiscard]] float readBlock(const Update& update) const;
  [[nodiscard]] float readWords(const Update& update) const;
  [[nodiscard]] float readFamilies(const Update& update) const;
  template <typename Visit>
  void forEachMarkedWord(const Update& update, Visit&& visit) const;
  void finish(Node* node);

  std::vector<Node*> opened_;  ///< Those above before those below.
  float read_ = 0.0F;          ///< Ahead; means nothing, but what is used has to be read.
};

}  // namespace occusg
