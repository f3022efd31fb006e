// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tree_writer.hpp"

#include <algorithm>
#include <limits>

namespace occusg {
namespace {

unsigned childIndex(const TreeWriter::Update& update, unsigned depth) {
  return static_cast<unsigned>(update.block->code >> (3 * (kBlockDepth - 1 - depth))) & 7U;
}

/// Bits of the first `voxels` voxels.
std::uint64_t lowest(unsigned voxels) {
  return voxels == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << voxels) - 1;
}

/// Takes note of the marked voxels of one word of a block.
void note(const VoxelBlock& block, unsigned word, std::uint64_t settled, SettledBlock& listed) {
  const std::uint64_t free = block.free[word];
  const std::uint64_t occupied = block.occupied[word];
  listed.free[word] = (listed.free[word] & ~occupied) | (settled & free);
  listed.occupied[word] = (listed.occupied[word] & ~free) | (settled & occupied);
}

}  // namespace

TreeWriter::TreeWriter(const octomap::OcTree& tree) : octomap::OcTree(tree.getResolution()) {
  prob_hit_log = tree.getProbHitLog();
  prob_miss_log = tree.getProbMissLog();
  clamping_thres_min = tree.getClampingThresMinLog();
  clamping_thres_max = tree.getClampingThresMaxLog();
  occ_prob_thres_log = tree.getOccupancyThresLog();
}

std::size_t TreeWriter::takeGrowth() {
  const std::size_t growth = tree_size;
  tree_size = 0;
  return growth;
}

void TreeWriter::open(const Place& root_node, const Updates& updates) {
  opened_.clear();
  openBelow(root_node, 0, updates);
}

void TreeWriter::openBelow(const Place& place, unsigned depth, const Updates& updates) {
  if (depth == kBlockDepth) {
    updates.first->place = place;
    return;
  }
  if (skips(place, updates)) return;
  opened_.push_back(place.node);
  Update* first = updates.first;
  while (first != updates.last) {
    const unsigned index = childIndex(*first, depth);
    Update* const next = std::find_if(first, updates.last, [&](const Update& update) {
      return childIndex(update, depth) != index;
    });
    openBelow(child(place, index), depth + 1, {first, next});
    first = next;
  }
}

/// True when a leaf stands for all blocks and none of them changes it.
bool TreeWriter::skips(const Place& place, const Updates& updates) const {
  if (!isLeaf(place)) return false;
  Marks marks;
  for (const Update* update = updates.first; update != updates.last; ++update) {
    for (unsigned i = 0; i < 8; ++i) {
      marks.free |= update->block->free[i];
      marks.occupied |= update->block->occupied[i];
    }
  }
  if (!ignores(place, marks)) return false;
  for (const Update* update = updates.first; update != updates.last; ++update)
    for (unsigned i = 0; i < 8; ++i) note(*update->block, i, lowest(64), *update->settled);
  return true;
}

void TreeWriter::close() {
  for (auto node = opened_.rbegin(); node != opened_.rend(); ++node) finish(*node);
}

void TreeWriter::write(const Updates& updates) {
  for (Update* update = updates.first; update != updates.last; ++update) {
    readAhead(update, updates.last);
    if (update->place.node != nullptr) writeBlock(*update);
  }
}

void TreeWriter::writeBlock(Update& update) {
  const VoxelBlock& block = *update.block;
  for (unsigned i = 0; i < block.free.size(); ++i) {
    const Marks marks{block.free[i], block.occupied[i]};
    if ((marks.free | marks.occupied) == 0) continue;
    if (ignores(update.place, marks)) {
      note(block, i, lowest(64), *update.settled);
      continue;
    }
    const Outcome below = writeBelow(child(update.place, i), 64, marks);
    update.change.changed[i] = below.free | below.occupied;
    update.change.occupied[i] = below.occupied;
    note(block, i, below.settled, *update.settled);
  }
  finish(update.place.node);
}

/// Nodes are scattered over the heap, and one is known only from the one above: waiting for each in
/// turn would take most of an update. So they are read while earlier blocks are written, one level
/// of the tree a block. Processors may ignore a prefetch of a page they have to look up first,
/// which is what nodes need most; they cannot ignore a read.
void TreeWriter::readAhead(const Update* update, const Update* last) {
  const auto left = last - update;
  if (left > 3) read_ += readBlock(update[3]);
  if (left > 2) read_ += readWords(update[2]);
  if (left > 1) read_ += readFamilies(update[1]);
}

float TreeWriter::readChildren(const Node* node) const {
  float sum = 0.0F;
  for (unsigned i = 0; i < 8; ++i)
    if (nodeChildExists(node, i)) sum += getNodeChild(node, i)->getLogOdds();
  return sum;
}

float TreeWriter::readBlock(const Update& update) const {
  return update.place.node == nullptr ? 0.0F : readChildren(update.place.node);
}

float TreeWriter::readWords(const Update& update) const {
  float sum = 0.0F;
  forEachMarkedWord(update, [&](const Node* word, std::uint64_t) { sum += readChildren(word); });
  return sum;
}

float TreeWriter::readFamilies(const Update& update) const {
  float sum = 0.0F;
  forEachMarkedWord(update, [&](const Node* word, std::uint64_t marks) {
    for (unsigned i = 0; i < 8; ++i) {
      if (((marks >> (8 * i)) & lowest(8)) != 0 && nodeChildExists(word, i))
        sum += readChildren(getNodeChild(word, i));
    }
  });
  return sum;
}

template <typename Visit>
void TreeWriter::forEachMarkedWord(const Update& update, Visit&& visit) const {
  const Node* block = update.place.node;
  if (block == nullptr || !nodeHasChildren(block)) return;
  for (unsigned i = 0; i < 8; ++i) {
    const std::uint64_t marks = update.block->free[i] | update.block->occupied[i];
    if (marks != 0 && nodeChildExists(block, i)) visit(getNodeChild(block, i), marks);
  }
}

/// @param voxels number of voxels below the node: 64 or 8.
TreeWriter::Outcome TreeWriter::writeBelow(const Place& place, unsigned voxels,
                                           const Marks& marks) {
  if (ignores(place, marks)) return {0, 0, marks.free | marks.occupied};
  const std::uint64_t all = lowest(voxels);
  if ((isLeaf(place) || place.age == Age::kNew) && (marks.free == all || marks.occupied == all))
    return writeLeaf(place, all, marks);
  if (voxels == 8) return writeVoxels(place, marks);
  const unsigned part = voxels / 8;
  Outcome outcome;
  for (unsigned i = 0; i < 8; ++i) {
    const Marks below{(marks.free >> (i * part)) & lowest(part),
                      (marks.occupied >> (i * part)) & lowest(part)};
    if ((below.free | below.occupied) == 0) continue;
    const Outcome of_child = writeBelow(child(place, i), part, below);
    outcome.free |= of_child.free << (i * part);
    outcome.occupied |= of_child.occupied << (i * part);
    outcome.settled |= of_child.settled << (i * part);
  }
  finish(place.node);
  return outcome;
}

/// Of a node of eight voxels: what `writeLeaf` and `finish` do, in one pass over the children.
TreeWriter::Outcome TreeWriter::writeVoxels(const Place& place, const Marks& marks) {
  if (isLeaf(place)) expandNode(place.node);
  Outcome outcome;
  float lowest_log_odds = std::numeric_limits<float>::max();
  float highest_log_odds = std::numeric_limits<float>::lowest();
  unsigned known = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const std::uint64_t bit = std::uint64_t{1} << i;
    if (((marks.free | marks.occupied) & bit) != 0) {
      const Outcome of_voxel = writeLeaf(child(place, i), bit, marks);
      outcome.free |= of_voxel.free;
      outcome.occupied |= of_voxel.occupied;
      outcome.settled |= of_voxel.settled;
    } else if (!nodeChildExists(place.node, i)) {
      continue;
    }
    ++known;
    const float log_odds = getNodeChild(place.node, i)->getLogOdds();
    lowest_log_odds = std::min(lowest_log_odds, log_odds);
    highest_log_odds = std::max(highest_log_odds, log_odds);
  }
  place.node->setLogOdds(highest_log_odds);
  if (known == 8 && !(lowest_log_odds < highest_log_odds)) (void)pruneNode(place.node);
  return outcome;
}

/// @param all the voxels the node stands for, all of which have the same mark.
TreeWriter::Outcome TreeWriter::writeLeaf(const Place& place, std::uint64_t all,
                                          const Marks& marks) {
  const bool is_hit = (marks.occupied & all) != 0;
  const float before = place.node->getLogOdds();
  const float sum = before + (is_hit ? prob_hit_log : prob_miss_log);
  const float after = std::min(std::max(sum, clamping_thres_min), clamping_thres_max);
  place.node->setLogOdds(after);
  const bool was_occupied = before >= occ_prob_thres_log;
  const bool is_occupied = after >= occ_prob_thres_log;
  const bool is_settled = is_hit ? after >= clamping_thres_max : after <= clamping_thres_min;
  const std::uint64_t settled = is_settled ? all : 0;
  if (place.age == Age::kOld && was_occupied == is_occupied) return {0, 0, settled};
  return is_occupied ? Outcome{0, all, settled} : Outcome{all, 0, settled};
}

TreeWriter::Place TreeWriter::child(const Place& parent, unsigned index) {
  if (isLeaf(parent)) expandNode(parent.node);
  if (nodeChildExists(parent.node, index)) return {getNodeChild(parent.node, index), Age::kOld};
  return {createNodeChild(parent.node, index), Age::kNew};
}

/// A node that stands for all voxels below it; a node this frame made stands for none yet.
bool TreeWriter::isLeaf(const Place& place) const {
  return place.age == Age::kOld && !nodeHasChildren(place.node);
}

/// True when the marks leave the voxels of a leaf as they are: clamped values do not move further.
bool TreeWriter::ignores(const Place& place, const Marks& marks) const {
  if (!isLeaf(place)) return false;
  const float log_odds = place.node->getLogOdds();
  return (marks.occupied == 0 && log_odds <= clamping_thres_min) ||
         (marks.free == 0 && log_odds >= clamping_thres_max);
}

/// Prunes a node, or makes its value the largest of its children.
void TreeWriter::finish(Node* node) {
  if (!nodeHasChildren(node) || pruneNode(node)) return;
  float highest_log_odds = std::numeric_limits<float>::lowest();
  for (unsigned i = 0; i < 8; ++i) {
    if (nodeChildExists(node, i))
      highest_log_odds = std::max(highest_log_odds, getNodeChild(node, i)->getLogOdds());
  }
  node->setLogOdds(highest_log_odds);
}

}  // namespace occusg
