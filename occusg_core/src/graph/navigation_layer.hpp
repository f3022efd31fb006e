// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "graph/navigation_block.hpp"
#include "occusg/graph/graph_config.hpp"
#include "occusg/graph/scene_graph.hpp"

namespace occusg {

/// Navigation nodes on a lattice of blocks aligned to world zero, and the traversable edges between
/// them (paper, Sec. 3.4). Only blocks in which a cell became free or stopped being so are touched.
class NavigationLayer {
 public:
  /// @param floor_z_m height of the nodes in the map frame [m].
  /// @throws Error when a value is out of range.
  NavigationLayer(const NavigationLayerConfig& config, double floor_z_m);

  /// Goes on with the nodes of `graph`: the next update looks at their blocks, whatever changed,
  /// and leaves each part of free space the node that stands in it.
  void restore(const SceneGraph& graph);

  /// Brings nodes and edges up to date. The graph's navigation nodes belong to this layer.
  /// @param changed bounds of the cells that differ from the layer of the last call.
  void update(SceneGraph& graph, const FreeSpace& layer, const CellBox& changed, double stamp_s);

  /// How many blocks the last update found changed.
  [[nodiscard]] std::size_t changedBlocks() const { return changed_blocks_; }

 private:
  using BlockPair = std::pair<Cell, Cell>;
  struct WantedSite {
    NavigationBlock::Part part = NavigationBlock::kNoPart;
    int free_cells = 0;
    Cell cell;
    std::optional<NodeId> node;  ///< The one it had; empty: a new one.
  };

  /// The blocks as the saved graph knew them, as far as the layer tells: with today's cells.
  [[nodiscard]] std::map<Cell, NavigationBlock> restoredBlocks(const SceneGraph& graph,
                                                               const FreeSpace& layer);
  [[nodiscard]] CellNeighbours neighbours() const;
  [[nodiscard]] const NavigationBlock& blockAt(const Cell& index) const;
  [[nodiscard]] bool deservesNode(int free_cells, bool has_node) const;
  [[nodiscard]] std::vector<WantedSite> sitesInParts(const NavigationBlock& old,
                                                     const NavigationBlock& fresh) const;
  [[nodiscard]] std::vector<WantedSite> siteOfBlock(const NavigationBlock& old,
                                                    const NavigationBlock& fresh,
                                                    const Cell& index) const;
  [[nodiscard]] bool areJoined(const BlockPair& blocks, NavigationBlock::Part a,
                               NavigationBlock::Part b) const;
  [[nodiscard]] bool cutsCorner(const BlockPair& blocks) const;

  static void noteJoins(const Cell& index, std::set<BlockPair>& to_join);
  void replaceBlock(SceneGraph& graph, const FreeSpace& layer, const Cell& index,
                    NavigationBlock fresh, double stamp_s);
  NodeId place(SceneGraph& graph, const FreeSpace& layer, const Cell& index,
               const NavigationBlock& fresh, const WantedSite& site, double stamp_s) const;
  [[nodiscard]] bool isStraightWayFree(const SceneGraph& graph, const FreeSpace& layer, NodeId a,
                                       NodeId b) const;
  void joinBlocks(SceneGraph& graph, const FreeSpace& layer, const BlockPair& blocks) const;

  NavigationLayerConfig config_;
  double floor_z_m_;
  std::map<Cell, NavigationBlock> blocks_;  ///< Those with a free cell or a node.
  std::set<NodeId> restored_;  ///< Nodes of a saved graph whose blocks are not known yet.
  std::size_t changed_blocks_ = 0;
};

}  // namespace occusg
