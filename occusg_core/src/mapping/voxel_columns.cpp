// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxel_columns.hpp"

#include <algorithm>
#include <string>

#include "mapping/voxel_tree.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr int kZeroBlock = kZeroKey / kBlockSide;
constexpr int kPageSide = 64;
constexpr int kDirectorySide = 2 * kZeroBlock / kPageSide;
constexpr std::uint64_t kFullWord = ~std::uint64_t{0};

int floorOfBlock(int voxel) { return (voxel + kZeroKey) / kBlockSide - kZeroBlock; }

/// Exchanges the bits whose place differs by `shift`: those under `mask` and the ones above.
std::uint64_t exchanged(std::uint64_t word, unsigned shift, std::uint64_t mask) {
  const std::uint64_t differing = ((word >> shift) ^ word) & mask;
  return word ^ differing ^ (differing << shift);
}

/// 4 x 4 x 4 voxels from Morton order (place z1 y1 x1 z0 y0 x0 in binary) to columns of four bits
/// (place y1 y0 x1 x0 z1 z0). Each step exchanges two digits of the place.
std::uint64_t columnsOfWord(std::uint64_t word) {
  word = exchanged(word, 3, 0x0A0A0A0A0A0A0A0AU);   // x0 and z0
  word = exchanged(word, 30, 0x00000000CCCCCCCCU);  // y0 and z1
  word = exchanged(word, 16, 0x00000000FFFF0000U);  // y1 and y0
  return word;
}

/// Bytes 8 * y + x of a block in Morton order.
std::array<std::uint8_t, 64> columnsOfBlock(const std::array<std::uint64_t, 8>& words) {
  std::array<std::uint8_t, 64> columns{};
  for (unsigned i = 0; i < words.size(); ++i) {
    if (words[i] == 0) continue;
    const std::uint64_t nibbles = columnsOfWord(words[i]);
    const unsigned corner = 4 * (i & 1U) + 32 * ((i >> 1) & 1U);
    const unsigned lift = 4 * (i >> 2);
    for (unsigned column = 0; column < 16; ++column) {
      const auto nibble = static_cast<std::uint8_t>((nibbles >> (4 * column)) & 15U);
      std::uint8_t& byte = columns[corner + 8 * (column >> 2) + (column & 3U)];
      byte = static_cast<std::uint8_t>(byte | nibble << lift);
    }
  }
  return columns;
}

/// Row-major place of a cell of a square.
std::size_t placeIn(int side, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
}

std::size_t placeInDirectory(const Cell& tile) {
  return placeIn(kDirectorySide, (tile.x + kZeroBlock) / kPageSide,
                 (tile.y + kZeroBlock) / kPageSide);
}

std::size_t placeInPage(const Cell& tile) {
  return placeIn(kPageSide, (tile.x + kZeroBlock) % kPageSide, (tile.y + kZeroBlock) % kPageSide);
}

/// Number of blocks at or below the nodes that stand for voxels, at most `cap` + 1.
std::size_t countBlocks(const octomap::OcTree& tree, const octomap::OcTreeNode* node,
                        unsigned level, std::size_t cap) {
  if (level <= kBlockLevels) return 1;
  if (!tree.nodeHasChildren(node)) {
    const unsigned levels = 3 * (level - kBlockLevels);
    return std::min(std::size_t{1} << levels, cap + 1);
  }
  std::size_t count = 0;
  for (unsigned i = 0; i < 8 && count <= cap; ++i) {
    if (tree.nodeChildExists(node, i))
      count += countBlocks(tree, tree.getNodeChild(node, i), level - 1, cap);
  }
  return std::min(count, cap + 1);
}

/// The states of the voxels below a node, at bits `place` and up.
void addVoxels(const octomap::OcTree& tree, const octomap::OcTreeNode* node, unsigned level,
               unsigned place, BlockChange& block) {
  if (level > 0 && tree.nodeHasChildren(node)) {
    const unsigned part = 1U << (3 * (level - 1));
    for (unsigned i = 0; i < 8; ++i) {
      if (tree.nodeChildExists(node, i))
        addVoxels(tree, tree.getNodeChild(node, i), level - 1, place + i * part, block);
    }
    return;
  }
  const bool is_occupied = tree.isNodeOccupied(node);
  for (unsigned voxel = place; voxel < place + (1U << (3 * level)); ++voxel) {
    const std::uint64_t bit = std::uint64_t{1} << (voxel & 63U);
    block.changed[voxel >> 6] |= bit;
    if (is_occupied) block.occupied[voxel >> 6] |= bit;
  }
}

}  // namespace

VoxelColumns VoxelColumns::of(const octomap::OcTree& tree) {
  VoxelColumns columns;
  if (tree.getRoot() == nullptr) return columns;
  const std::size_t blocks =
      countBlocks(tree, tree.getRoot(), tree.getTreeDepth(), kMaxColumnBlocks);
  if (blocks > kMaxColumnBlocks) {
    throw refuse("occupancy map", "its known voxels fill more blocks of 8 x 8 x 8 than supported",
                 "at most " + std::to_string(kMaxColumnBlocks) + " are");
  }
  columns.addNode(tree, tree.getRoot(), tree.getTreeDepth(), {-kZeroKey, -kZeroKey, -kZeroKey});
  return columns;
}

void VoxelColumns::addNode(const octomap::OcTree& tree, const octomap::OcTreeNode* node,
                           unsigned level, const std::array<int, 3>& corner) {
  if (level > kBlockLevels && tree.nodeHasChildren(node)) {
    const int half = 1 << (level - 1);
    for (unsigned i = 0; i < 8; ++i) {
      if (!tree.nodeChildExists(node, i)) continue;
      const std::array<int, 3> below = {corner[0] + half * static_cast<int>(i & 1U),
                                        corner[1] + half * static_cast<int>((i >> 1) & 1U),
                                        corner[2] + half * static_cast<int>(i >> 2)};
      addNode(tree, tree.getNodeChild(node, i), level - 1, below);
    }
    return;
  }
  BlockChange block;
  if (level <= kBlockLevels) {
    addVoxels(tree, node, level, 0, block);
  } else {
    block.changed.fill(kFullWord);
    if (tree.isNodeOccupied(node)) block.occupied.fill(kFullWord);
  }
  addBlocks(corner, std::max(1, (1 << level) / kBlockSide), block);
}

/// The same state for a cube of blocks.
void VoxelColumns::addBlocks(const std::array<int, 3>& corner, int side,
                             const BlockChange& change) {
  const Cell first{floorOfBlock(corner[0]), floorOfBlock(corner[1])};
  const int lowest = floorOfBlock(corner[2]);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      for (int z = 0; z < side; ++z) (void)apply({first.x + x, first.y + y}, lowest + z, change);
  }
}

VoxelColumns::VoxelColumns() { clear(); }

void VoxelColumns::clear() {
  directory_.assign(static_cast<std::size_t>(kDirectorySide) * kDirectorySide, 0);
  pages_.clear();
  tiles_.clear();
}

std::uint64_t VoxelColumns::apply(const Cell& tile, int block_z, const BlockChange& change) {
  const std::array<std::uint8_t, 64> changed = columnsOfBlock(change.changed);
  const std::array<std::uint8_t, 64> occupied = columnsOfBlock(change.occupied);
  Slab& slab = slabAt(tileAt(tile), block_z);
  std::uint64_t columns = 0;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    const auto kept = static_cast<std::uint8_t>(~changed[i]);
    slab.free[i] = static_cast<std::uint8_t>((slab.free[i] & kept) | (changed[i] & ~occupied[i]));
    slab.occupied[i] = static_cast<std::uint8_t>((slab.occupied[i] & kept) | occupied[i]);
    columns |= static_cast<std::uint64_t>(changed[i] != 0) << i;
  }
  return columns;
}

void VoxelColumns::read(const Cell& column, ColumnBits& bits) const {
  bits.clear();
  const Cell name{floorOfBlock(column.x), floorOfBlock(column.y)};
  const Tile* tile = find(name);
  if (tile == nullptr) return;
  const auto byte = static_cast<std::size_t>(kBlockSide * (column.y - kBlockSide * name.y) +
                                             column.x - kBlockSide * name.x);
  for (const Slab& slab : tile->slabs) {
    if ((slab.free[byte] | slab.occupied[byte]) != 0)
      bits.addByte(kBlockSide * slab.block_z, slab.free[byte], slab.occupied[byte]);
  }
}

std::vector<Cell> VoxelColumns::knownColumns() const {
  std::vector<Cell> columns;
  for (const Tile& tile : tiles_) {
    for (int i = 0; i < kBlockSide * kBlockSide; ++i) {
      const auto byte = static_cast<std::size_t>(i);
      const bool is_known = std::any_of(
          tile.slabs.begin(), tile.slabs.end(),
          [byte](const Slab& slab) { return (slab.free[byte] | slab.occupied[byte]) != 0; });
      if (!is_known) continue;
      columns.push_back(
          {kBlockSide * tile.name.x + i % kBlockSide, kBlockSide * tile.name.y + i / kBlockSide});
    }
  }
  return columns;
}

std::size_t VoxelColumns::memoryBytes() const {
  std::size_t bytes = directory_.capacity() * sizeof(std::uint32_t) +
                      pages_.size() * kPageSide * kPageSide * sizeof(std::uint32_t) +
                      tiles_.capacity() * sizeof(Tile);
  for (const Tile& tile : tiles_) bytes += tile.slabs.capacity() * sizeof(Slab);
  return bytes;
}

bool operator==(const VoxelColumns& a, const VoxelColumns& b) {
  if (a.tiles_.size() != b.tiles_.size()) return false;
  return std::all_of(a.tiles_.begin(), a.tiles_.end(), [&b](const VoxelColumns::Tile& tile) {
    const VoxelColumns::Tile* other = b.find(tile.name);
    return other != nullptr &&
           std::equal(tile.slabs.begin(), tile.slabs.end(), other->slabs.begin(),
                      other->slabs.end(), [](const auto& one, const auto& two) {
                        return one.block_z == two.block_z && one.free == two.free &&
                               one.occupied == two.occupied;
                      });
  });
}

const VoxelColumns::Tile* VoxelColumns::find(const Cell& name) const {
  const std::uint32_t page = directory_[placeInDirectory(name)];
  if (page == 0) return nullptr;
  const std::uint32_t tile = pages_[page - 1][placeInPage(name)];
  return tile == 0 ? nullptr : &tiles_[tile - 1];
}

VoxelColumns::Tile& VoxelColumns::tileAt(const Cell& name) {
  std::uint32_t& page = directory_[placeInDirectory(name)];
  if (page == 0) {
    pages_.emplace_back(static_cast<std::size_t>(kPageSide) * kPageSide, 0);
    page = static_cast<std::uint32_t>(pages_.size());
  }
  std::uint32_t& tile = pages_[page - 1][placeInPage(name)];
  if (tile == 0) {
    tiles_.push_back({name, {}});
    tile = static_cast<std::uint32_t>(tiles_.size());
  }
  return tiles_[tile - 1];
}

VoxelColumns::Slab& VoxelColumns::slabAt(Tile& tile, int block_z) {
  const auto place =
      std::lower_bound(tile.slabs.begin(), tile.slabs.end(), block_z,
                       [](const Slab& slab, int height) { return slab.block_z < height; });
  if (place != tile.slabs.end() && place->block_z == block_z) return *place;
  Slab slab;
  slab.block_z = block_z;
  return *tile.slabs.insert(place, slab);
}

}  // namespace occusg
