// SPDX-License-Identifier: BSD-3-Clause
#include "graph/navigation_layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>
#include <utility>

#include "mapping/cells_on_line.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

using Part = NavigationBlock::Part;

const NavigationLayerConfig& usable(const NavigationLayerConfig& config) {
  if (checked(config).min_kept_cells <= config.min_free_cells) return config;
  throw refuse("graph.navigation.min_kept_cells", "is " + std::to_string(config.min_kept_cells),
               "it must be at most min_free_cells = " + std::to_string(config.min_free_cells));
}

int floorDivided(int value, int divisor) {
  const int quotient = value / divisor;
  return value % divisor < 0 ? quotient - 1 : quotient;
}

CellBox blocksOf(const CellBox& cells, int side) {
  if (cells.empty()) return {};
  return {{floorDivided(cells.min.x, side), floorDivided(cells.min.y, side)},
          {floorDivided(cells.max.x - 1, side) + 1, floorDivided(cells.max.y - 1, side) + 1}};
}

/// Sets of parts of two blocks: those of the first, then those of the second.
class PartSets {
 public:
  explicit PartSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t item) const {
    while (parent_[item] != item) item = parent_[item];
    return item;
  }
  void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

NavigationLayer::NavigationLayer(const NavigationLayerConfig& config, double floor_z_m)
    : config_(usable(config)), floor_z_m_(floor_z_m) {}

CellNeighbours NavigationLayer::neighbours() const {
  return config_.nodes == NavigationNodes::kOnePerPart ? CellNeighbours::kSides
                                                       : CellNeighbours::kSidesAndCorners;
}

const NavigationBlock& NavigationLayer::blockAt(const Cell& index) const {
  static const NavigationBlock empty;
  const auto found = blocks_.find(index);
  return found == blocks_.end() ? empty : found->second;
}

void NavigationLayer::restore(const SceneGraph& graph) {
  *this = NavigationLayer(config_, floor_z_m_);
  for (const auto& [id, node] : graph.nodes(NodeType::kNavigation)) restored_.insert(id);
}

void NavigationLayer::update(SceneGraph& graph, const FreeSpace& layer, const CellBox& changed,
                             double stamp_s) {
  changed_blocks_ = 0;
  std::set<BlockPair> to_join;
  for (auto& [index, block] : restoredBlocks(graph, layer)) {
    blocks_[index] = block;
    ++changed_blocks_;
    block.sites.clear();
    replaceBlock(graph, layer, index, std::move(block), stamp_s);
    noteJoins(index, to_join);
  }
  const CellBox indices = blocksOf(changed.intersected(layer.cells.box()), config_.block_cells);
  for (int y = indices.min.y; y < indices.max.y; ++y) {
    for (int x = indices.min.x; x < indices.max.x; ++x) {
      NavigationBlock fresh(layer, {x, y}, config_.block_cells, neighbours());
      if (fresh.hasSameCells(blockAt({x, y}))) continue;
      ++changed_blocks_;
      replaceBlock(graph, layer, {x, y}, std::move(fresh), stamp_s);
      noteJoins({x, y}, to_join);
    }
  }
  for (const BlockPair& blocks : to_join) joinBlocks(graph, layer, blocks);
}

// A block has to do with the pairs it is one of and with those that meet at its corners.
void NavigationLayer::noteJoins(const Cell& index, std::set<BlockPair>& to_join) {
  const auto& [x, y] = index;
  for (const int dy : {-1, 0, 1}) {
    for (const int dx : {-1, 0, 1})
      if (dx != 0 || dy != 0) to_join.insert(std::minmax(Cell{x, y}, Cell{x + dx, y + dy}));
  }
  for (const int dy : {-1, 1})
    for (const int dx : {-1, 1}) to_join.insert(std::minmax(Cell{x + dx, y}, Cell{x, y + dy}));
}

std::map<Cell, NavigationBlock> NavigationLayer::restoredBlocks(const SceneGraph& graph,
                                                                const FreeSpace& layer) {
  std::map<Cell, NavigationBlock> blocks;
  for (const NodeId id : std::exchange(restored_, {})) {
    const Node* const node = graph.find(id);
    if (node == nullptr) continue;
    // By its place, as the side of the blocks may have been another.
    const Cell cell = layer.frame.cellAt(node->groundPosition());
    const Cell index{floorDivided(cell.x, config_.block_cells),
                     floorDivided(cell.y, config_.block_cells)};
    auto block = blocks.find(index);
    if (block == blocks.end()) {
      NavigationBlock known(layer, index, config_.block_cells, neighbours());
      block = blocks.emplace(index, std::move(known)).first;
    }
    block->second.sites.push_back({id, block->second.partNearest(cell)});
  }
  return blocks;
}

bool NavigationLayer::deservesNode(int free_cells, bool has_node) const {
  return free_cells >= (has_node ? config_.min_kept_cells : config_.min_free_cells);
}

std::vector<NavigationLayer::WantedSite> NavigationLayer::sitesInParts(
    const NavigationBlock& old, const NavigationBlock& fresh) const {
  std::vector<std::optional<NodeId>> node_of_part(fresh.parts().size() + 1);
  for (const NavigationBlock::Site& site : old.sites) {
    const std::vector<int> common = fresh.commonCells(old, site.part);
    Part best = NavigationBlock::kNoPart;
    for (std::size_t part = 1; part < common.size(); ++part)
      if (!node_of_part[part] && common[part] > common[best]) best = static_cast<Part>(part);
    if (best != NavigationBlock::kNoPart) node_of_part[best] = site.node;
  }
  std::vector<WantedSite> sites;
  for (std::size_t part = 1; part <= fresh.parts().size(); ++part) {
    const NavigationBlock::Extent& extent = fresh.parts()[part - 1];
    if (deservesNode(extent.cells, node_of_part[part].has_value()))
      sites.push_back({static_cast<Part>(part), extent.cells, extent.medoid, node_of_part[part]});
  }
  return sites;
}

std::vector<NavigationLayer::WantedSite> NavigationLayer::siteOfBlock(const NavigationBlock& old,
                                                                      const NavigationBlock& fresh,
                                                                      const Cell& index) const {
  const std::optional<NodeId> node =
      old.sites.empty() ? std::nullopt : std::optional<NodeId>(old.sites.front().node);
  const int free_cells = fresh.freeCells();
  if (!deservesNode(free_cells, node.has_value())) return {};
  const Part part =
      fresh.empty() ? NavigationBlock::kNoPart : fresh.partAt(fresh.cellNearestToMiddle());
  return {{part, free_cells, index, node}};
}

void NavigationLayer::replaceBlock(SceneGraph& graph, const FreeSpace& layer, const Cell& index,
                                   NavigationBlock fresh, double stamp_s) {
  const NavigationBlock& old = blockAt(index);
  const std::vector<WantedSite> sites = config_.nodes == NavigationNodes::kOnePerPart
                                            ? sitesInParts(old, fresh)
                                            : siteOfBlock(old, fresh, index);
  for (const NavigationBlock::Site& site : old.sites) {
    const bool stays = std::any_of(sites.begin(), sites.end(), [&](const WantedSite& wanted) {
      return wanted.node == site.node;
    });
    if (!stays) graph.remove(site.node);
  }
  for (const WantedSite& site : sites)
    fresh.sites.push_back({place(graph, layer, index, fresh, site, stamp_s), site.part});
  std::sort(fresh.sites.begin(), fresh.sites.end(),
            [](const auto& a, const auto& b) { return a.node < b.node; });
  if (fresh.empty() && fresh.sites.empty()) {
    blocks_.erase(index);
  } else {
    blocks_[index] = std::move(fresh);
  }
}

NodeId NavigationLayer::place(SceneGraph& graph, const FreeSpace& layer, const Cell& index,
                              const NavigationBlock& fresh, const WantedSite& site,
                              double stamp_s) const {
  const bool on_free_cell = config_.nodes == NavigationNodes::kOnePerPart;
  const double side_m = config_.block_cells * layer.frame.resolution_m;
  Point2 at = on_free_cell ? layer.frame.center(site.cell)
                           : Point2{(index.x + 0.5) * side_m, (index.y + 0.5) * side_m};
  const NavigationAttributes attributes{index, site.free_cells};
  if (!site.node) return graph.add({at.x, at.y, floor_z_m_}, stamp_s, attributes).id;
  Node node = graph.at(*site.node);
  // A cell more or less must not move a node a planner has been told of.
  const Cell before = layer.frame.cellAt(node.groundPosition());
  const int moved_cells =
      std::max(std::abs(before.x - site.cell.x), std::abs(before.y - site.cell.y));
  const bool may_stay =
      on_free_cell && fresh.partAt(before) == site.part && 5 * moved_cells <= config_.block_cells;
  if (may_stay) at = node.groundPosition();
  node.position = {at.x, at.y, floor_z_m_};
  node.last_seen_s = stamp_s;
  node.attributes = attributes;
  graph.update(std::move(node));
  return *site.node;
}

bool NavigationLayer::cutsCorner(const BlockPair& blocks) const {
  const Cell& a = blocks.first;
  const Cell& b = blocks.second;
  const int last = config_.block_cells - 1;
  // The blocks beside both, and in each the cell at the common corner.
  const NavigationBlock& beside_a = blockAt({b.x, a.y});
  const NavigationBlock& beside_b = blockAt({a.x, b.y});
  const int ax = b.x > a.x ? last : 0;
  const int ay = b.y > a.y ? last : 0;
  return beside_a.partAt(last - ax, ay) == NavigationBlock::kNoPart ||
         beside_b.partAt(ax, last - ay) == NavigationBlock::kNoPart;
}

bool NavigationLayer::areJoined(const BlockPair& blocks, Part a, Part b) const {
  const NavigationBlock& first = blockAt(blocks.first);
  const NavigationBlock& second = blockAt(blocks.second);
  const int dx = blocks.second.x - blocks.first.x;
  const int dy = blocks.second.y - blocks.first.y;
  const auto contacts = contactsBetween(first, second, dx, dy, config_.block_cells, neighbours());
  if (config_.nodes == NavigationNodes::kOnePerPart) {
    if (dx != 0 && dy != 0 && cutsCorner(blocks)) return false;
    return std::binary_search(contacts.begin(), contacts.end(), std::make_pair(a, b));
  }
  if (a == NavigationBlock::kNoPart || b == NavigationBlock::kNoPart) return false;
  const std::size_t offset = first.parts().size() + 1;
  PartSets sets(offset + second.parts().size() + 1);
  for (const auto& [of_first, of_second] : contacts) sets.join(of_first, offset + of_second);
  return sets.find(a) == sets.find(offset + b);
}

bool NavigationLayer::isStraightWayFree(const SceneGraph& graph, const FreeSpace& layer, NodeId a,
                                        NodeId b) const {
  if (config_.nodes == NavigationNodes::kOnePerBlock) return true;
  return holdsOnLine(
      layer.frame, graph.at(a).groundPosition(), graph.at(b).groundPosition(),
      [&](const Cell& cell) { return layer.cells.valueOr(cell, kUnknown) == kFree; });
}

void NavigationLayer::joinBlocks(SceneGraph& graph, const FreeSpace& layer,
                                 const BlockPair& blocks) const {
  for (const NavigationBlock::Site& a : blockAt(blocks.first).sites) {
    for (const NavigationBlock::Site& b : blockAt(blocks.second).sites) {
      const bool has_edge = graph.findEdge(EdgeType::kTraversable, a.node, b.node) != nullptr;
      const bool wants_edge =
          areJoined(blocks, a.part, b.part) && isStraightWayFree(graph, layer, a.node, b.node);
      if (wants_edge && !has_edge) graph.connect({EdgeType::kTraversable, a.node, b.node, {}});
      if (!wants_edge && has_edge) graph.disconnect(EdgeType::kTraversable, a.node, b.node);
    }
  }
}

}  // namespace occusg
