// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxel_tree.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <tuple>

namespace occusg {
namespace {

constexpr std::size_t kBlocksAtOnce = 16;

/// Every third bit of a Morton code from the lowest on, packed: one coordinate of the block.
int compact(std::uint64_t code) {
  int coordinate = 0;
  for (unsigned i = 0; i < kBlockDepth; ++i)
    coordinate |= static_cast<int>((code >> (3 * i)) & 1U) << i;
  return coordinate;
}

bool isEmpty(const BlockChange& change) {
  return std::all_of(change.changed.begin(), change.changed.end(),
                     [](std::uint64_t word) { return word == 0; });
}

}  // namespace

std::vector<Cell> VoxelTree::integrate(const std::vector<VoxelBlock>& blocks,
                                       SettledVoxels& settled, Workers& workers) {
  if (blocks.empty()) return {};
  openFrame(blocks, settled, workers.threads());
  write(workers);
  changed_.clear();
  for (const TreeWriter::Update& update : updates_)
    if (!isEmpty(update.change)) note(update);
  return changedColumns();
}

void VoxelTree::openFrame(const std::vector<VoxelBlock>& blocks, SettledVoxels& settled,
                          int threads) {
  updates_.clear();
  for (const VoxelBlock& block : blocks)
    updates_.push_back({&block, &settled.at(block.code), {}, {}});
  while (writers_.size() < static_cast<std::size_t>(threads))
    writers_.push_back(std::make_unique<TreeWriter>(*this));
}

TreeWriter::Place VoxelTree::top() {
  if (root != nullptr) return {root, TreeWriter::Age::kOld};
  root = new TreeWriter::Node();  // owned by the base class, which offers no other way to make one
  ++tree_size;
  return {root, TreeWriter::Age::kNew};
}

/// What a writer does below the node of one block does not depend on any other block.
void VoxelTree::write(Workers& workers) {
  TreeWriter::Update* const first = updates_.data();
  const std::size_t count = updates_.size();
  writers_.front()->open(top(), {first, first + count});
  const std::size_t share = workers.threads() == 1 ? count : kBlocksAtOnce;
  std::atomic<std::size_t> next{0};
  workers.run(workers.threads(), [&](int writer) {
    for (std::size_t i = next.fetch_add(share); i < count; i = next.fetch_add(share)) {
      writers_[static_cast<std::size_t>(writer)]->write(
          {first + i, first + std::min(i + share, count)});
    }
  });
  writers_.front()->close();
  for (const auto& writer : writers_) tree_size += writer->takeGrowth();
  size_changed = true;
}

void VoxelTree::note(const TreeWriter::Update& update) {
  constexpr int kZeroBlock = kZeroKey / kBlockSide;
  const std::uint64_t code = update.block->code;
  const Cell tile{compact(code) - kZeroBlock, compact(code >> 1) - kZeroBlock};
  const std::uint64_t columns =
      columns_.apply(tile, compact(code >> 2) - kZeroBlock, update.change);
  changed_.push_back({tile.x, tile.y, columns});
}

void VoxelTree::clear() {
  octomap::OcTree::clear();
  columns_.clear();
}

void VoxelTree::rebuildColumns() { columns_ = VoxelColumns::of(*this); }

std::vector<Cell> VoxelTree::changedColumns() {
  std::sort(changed_.begin(), changed_.end(), [](const BlockColumns& a, const BlockColumns& b) {
    return std::tie(a.y, a.x) < std::tie(b.y, b.x);
  });
  // Blocks above each other share their columns.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < changed_.size(); ++i) {
    const bool same =
        kept > 0 && changed_[kept - 1].x == changed_[i].x && changed_[kept - 1].y == changed_[i].y;
    if (same) {
      changed_[kept - 1].columns |= changed_[i].columns;
    } else {
      changed_[kept++] = changed_[i];
    }
  }
  changed_.resize(kept);

  std::vector<Cell> columns;
  for (auto row = changed_.begin(); row != changed_.end();) {
    const auto end = std::find_if(row, changed_.end(),
                                  [&](const BlockColumns& block) { return block.y != row->y; });
    for (int y = 0; y < kBlockSide; ++y) {
      for (auto block = row; block != end; ++block) {
        for (int x = 0; x < kBlockSide; ++x) {
          if ((block->columns >> (kBlockSide * y + x)) & 1U)
            columns.push_back({block->x * kBlockSide + x, block->y * kBlockSide + y});
        }
      }
    }
    row = end;
  }
  return columns;
}

}  // namespace occusg
