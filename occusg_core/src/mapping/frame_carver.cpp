// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/frame_carver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "mapping/morton.hpp"

namespace occusg {
namespace {

constexpr int kHalfBlock = kBlockSide / 2;
constexpr int kFirstBlock = -32768 / kBlockSide;
constexpr std::uint64_t kAll = ~std::uint64_t{0};
constexpr std::uint64_t kByte = 0xFF;
constexpr int kUndivided = 32;       ///< Pixels.
constexpr float kRowSpacing = 0.4F;  ///< Of the rows looked at in fast mode [voxels].
constexpr std::array<int, 5> kRowOrder = {0, -1, 1, -2, 2};
constexpr float kShortestPass = 1e-4F;  ///< Share of a ray, above what rounding can make up.
constexpr int kTasksPerThread = 24;
constexpr float kDepthSlack = 0.002F;  ///< Voxels.
constexpr float kPixelSlack = 0.02F;
constexpr float kNearestSurface = 4.0F;  ///< Voxels; nearer ones are as good as never seen.

int blockOf(int voxel) { return voxel >> 3; }

std::uint64_t codeOf(const VoxelIndex& block) {
  return mortonCode(static_cast<unsigned>(block.x - kFirstBlock),
                    static_cast<unsigned>(block.y - kFirstBlock),
                    static_cast<unsigned>(block.z - kFirstBlock));
}

/// The part of a cube of `side` voxels that has the given place in Morton order.
VoxelIndex partOf(const VoxelIndex& first, unsigned place, int side) {
  return {first.x + ((place & 1U) != 0 ? side : 0), first.y + ((place & 2U) != 0 ? side : 0),
          first.z + ((place & 4U) != 0 ? side : 0)};
}

Eigen::Map<const Float8> at(const std::vector<float>& values, std::size_t first) {
  return Eigen::Map<const Float8>(values.data() + first);
}

}  // namespace

std::size_t FrameCarver::blocksBetween(const std::array<VoxelIndex, 2>& bounds) {
  const auto side = [](int low, int high) {
    const int blocks = blockOf(high - 1) - blockOf(low) + 1;
    return static_cast<std::size_t>(blocks);
  };
  return side(bounds[0].x, bounds[1].x) * side(bounds[0].y, bounds[1].y) *
         side(bounds[0].z, bounds[1].z);
}

const std::vector<VoxelBlock>& FrameCarver::carve(const FrameRays& rays, const RangeImage& image,
                                                  const SettledVoxels& settled, Carving carving,
                                                  Workers& workers) {
  settled_ = &settled;
  carving_ = carving;
  openFrame(rays, image);
  depth_.begin(rays.width(), rays.height(), rays.largestDepth());
  const std::array<std::function<void()>, 3> tables = {[&] { mark(rays); },
                                                       [&] { depth_.buildNearest(rays.depth()); },
                                                       [&] { depth_.buildFarthest(rays.depth()); }};
  workers.run(3, [&](int table) { tables[static_cast<std::size_t>(table)](); });

  const int tasks = workers.threads() == 1 ? 1 : kTasksPerThread * workers.threads();
  const int rows = window_.size.y * window_.size.z;
  carved_.resize(static_cast<std::size_t>(tasks));
  workers.run(tasks, [&](int task) {
    auto& carved = carved_[static_cast<std::size_t>(task)];
    carved.clear();
    carveBlocks(rows * task / tasks, rows * (task + 1) / tasks, carved);
  });
  sortBlocks();
  return sorted_;
}

void FrameCarver::openFrame(const FrameRays& rays, const RangeImage& image) {
  rays_ = &rays;
  double farthest_m = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    origin_[axis] = static_cast<float>(rays.origin()[axis] / rays.resolution_m());
    farthest_m = std::max(farthest_m, std::abs(rays.origin()[axis]));
  }
  // Points are rounded to single precision where they are, which may be far from the map's origin.
  const auto rounding = static_cast<float>(
      4.0 * (farthest_m + 10.0) * std::numeric_limits<float>::epsilon() / rays.resolution_m());
  depth_slack_ = kDepthSlack + rounding;
  projection_ = LatticeProjection(
      image, kPixelSlack + rounding * static_cast<float>(image.camera.fx) / kNearestSurface);
}

/// Morton codes are unique, so the order does not depend on which task found a block.
void FrameCarver::sortBlocks() {
  order_.clear();
  for (const auto& carved : carved_)
    for (const VoxelBlock& block : carved) order_.push_back(&block);
  std::sort(order_.begin(), order_.end(),
            [](const VoxelBlock* a, const VoxelBlock* b) { return a->code < b->code; });
  sorted_.clear();
  for (const VoxelBlock* block : order_) sorted_.push_back(*block);
}

void FrameCarver::openWindow(const std::array<VoxelIndex, 2>& bounds) {
  const VoxelIndex last{blockOf(bounds[1].x - 1), blockOf(bounds[1].y - 1),
                        blockOf(bounds[1].z - 1)};
  window_.first = {blockOf(bounds[0].x), blockOf(bounds[0].y), blockOf(bounds[0].z)};
  window_.size = {last.x - window_.first.x + 1, last.y - window_.first.y + 1,
                  last.z - window_.first.z + 1};
  slots_.assign(blocksBetween(bounds), 0);
}

void FrameCarver::mark(const FrameRays& rays) {
  openWindow(rays.bounds());
  marked_.clear();
  rays.forEachMark([this](const MarkedVoxel& mark) {
    const VoxelIndex block{blockOf(mark.voxel.x), blockOf(mark.voxel.y), blockOf(mark.voxel.z)};
    const auto slot = static_cast<std::size_t>(
        ((block.z - window_.first.z) * window_.size.y + block.y - window_.first.y) *
            window_.size.x +
        block.x - window_.first.x);
    if (slots_[slot] == 0) {
      marked_.emplace_back();
      marked_.back().code = codeOf(block);
      slots_[slot] = static_cast<std::uint32_t>(marked_.size());
    }
    VoxelBlock& marked = marked_[slots_[slot] - 1];
    const unsigned place =
        placeInBlock(static_cast<unsigned>(mark.voxel.x), static_cast<unsigned>(mark.voxel.y),
                     static_cast<unsigned>(mark.voxel.z));
    auto& words = mark.kind == RayEnd::kHit ? marked.occupied : marked.free;
    words[place >> 6] |= std::uint64_t{1} << (place & 63U);
  });
}

void FrameCarver::carveBlocks(int first_row, int end_row, std::vector<VoxelBlock>& carved) {
  const std::array<double, 3>& origin = rays_->origin();
  const double voxels_per_m = 1.0 / rays_->resolution_m();
  const ViewPoint step = static_cast<float>(kBlockSide) * projection_.step(0);
  for (int row = first_row; row < end_row; ++row) {
    VoxelIndex block{window_.first.x, window_.first.y + row % window_.size.y,
                     window_.first.z + row / window_.size.y};
    const auto away = [&](int index, std::size_t axis) {
      return static_cast<float>(kBlockSide * index + kHalfBlock - origin[axis] * voxels_per_m);
    };
    const ViewPoint start = away(block.x, 0) * projection_.step(0) +
                            away(block.y, 1) * projection_.step(1) +
                            away(block.z, 2) * projection_.step(2);
    for (int i = 0; i < window_.size.x; ++i, ++block.x)
      carveBlock(block, start + static_cast<float>(i) * step, carved);
  }
}

void FrameCarver::carveBlock(const VoxelIndex& at, const ViewPoint& center,
                             std::vector<VoxelBlock>& carved) {
  const auto slot = static_cast<std::size_t>(
      ((at.z - window_.first.z) * window_.size.y + at.y - window_.first.y) * window_.size.x + at.x -
      window_.first.x);
  const VoxelBlock* marked = slots_[slot] == 0 ? nullptr : &marked_[slots_[slot] - 1];
  const Verdict verdict = judge(center, 0).verdict;
  if (verdict == Verdict::kNone && marked == nullptr) return;
  VoxelBlock result;
  if (marked != nullptr) result = *marked;
  result.code = codeOf(at);
  const SettledBlock& settled = settled_->of(result.code);
  if (verdict != Verdict::kNone) {
    Block block;
    block.done = settled.free;
    block.first_voxel = {kBlockSide * at.x, kBlockSide * at.y, kBlockSide * at.z};
    for (unsigned i = 0; i < 8; ++i) {
      block.done[i] |= result.occupied[i] | result.free[i];
      if (verdict == Verdict::kAll) {
        block.free[i] = kAll;
      } else {
        carveWord(block, i, center + projection_.corners(1)[i]);
      }
      result.free[i] |= block.free[i] & ~block.done[i];
    }
  }
  std::uint64_t any = 0;
  for (unsigned i = 0; i < 8; ++i) {
    result.free[i] &= ~(result.occupied[i] | settled.free[i]);
    result.occupied[i] &= ~settled.occupied[i];
    any |= result.free[i] | result.occupied[i];
  }
  if (any != 0) carved.push_back(result);
}

void FrameCarver::carveWord(Block& block, unsigned word, const ViewPoint& center) const {
  if (block.done[word] == kAll) return;
  const Verdict verdict = judge(center, 1).verdict;
  if (verdict == Verdict::kNone) return;
  if (verdict == Verdict::kAll) {
    block.free[word] = kAll;
    return;
  }
  for (unsigned i = 0; i < 8; ++i)
    block.free[word] |= carveByte(block, word, i, center + projection_.corners(2)[i]) << (8 * i);
}

std::uint64_t FrameCarver::carveByte(const Block& block, unsigned word, unsigned byte,
                                     const ViewPoint& center) const {
  const std::uint64_t done = block.done[word] >> (8 * byte) & kByte;
  if (done == kByte) return 0;
  const Judgement judgement = judge(center, 2);
  if (judgement.verdict == Verdict::kNone) return 0;
  if (judgement.verdict == Verdict::kAll) return kByte;
  const VoxelIndex first = partOf(partOf(block.first_voxel, word, 4), byte, 2);
  const CubeCorners& offsets = projection_.corners(3);
  const float half = offsets.depth + depth_slack_;
  const std::array<LatticeProjection::CenterPixel, 8> pixels = projection_.centerPixels(center);
  std::uint64_t free = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const float depth = center.z + offsets.z[i];
    if ((done >> i & 1U) != 0 || depth - half > judgement.farthest) continue;
    const auto& pixel = pixels[i];
    const bool passed = pixel.surely_crossed && endAt(pixel) >= depth + half;
    if (passed || isFree(partOf(first, i, 1), center + offsets[i], pixel))
      free |= std::uint64_t{1} << i;
  }
  return free;
}

float FrameCarver::endAt(const LatticeProjection::CenterPixel& pixel) const {
  return rays_
      ->depth()[static_cast<std::size_t>(pixel.row) * static_cast<std::size_t>(rays_->width()) +
                static_cast<std::size_t>(pixel.column)];
}

FrameCarver::Judgement FrameCarver::judge(const ViewPoint& center, std::size_t size) const {
  const float half = projection_.corners(size).depth + depth_slack_;
  const float nearest = center.z - half;
  const float farthest = center.z + half;
  if (farthest <= 0.0F || nearest >= depth_.largest()) return {};
  PixelBox box;
  const Coverage coverage = projection_.boxOf(center, size, box);
  if (coverage == Coverage::kNone) return {};
  const float end = depth_.farthest(box);
  if (end < nearest) return {};
  const bool all = coverage == Coverage::kWhole && farthest <= projection_.denseDepth() &&
                   end >= farthest && depth_.nearest(box) >= farthest;
  return {all ? Verdict::kAll : Verdict::kSome, end};
}

/// Looks at up to five rows of rays about the centre, the middle ones first.
bool FrameCarver::isFreeNearCenter(const VoxelIndex& voxel, const ViewPoint& center,
                                   const LatticeProjection::CenterPixel& pixel) const {
  const float nearest = center.z - projection_.corners(3).depth - depth_slack_;
  const int columns = std::min(projection_.columnsAbout(center, 3), kUndivided);
  const int step = std::max(1, static_cast<int>(projection_.rowsOver(kRowSpacing, center.z)));
  const int rows = std::min(projection_.rowsAbout(center, 3), 2 * step);
  const PixelBox box = {
      std::max(pixel.column - columns, 0), std::min(pixel.column + columns, rays_->width() - 1),
      std::max(pixel.row - rows, 0), std::min(pixel.row + rows, rays_->height() - 1)};
  if (depth_.farthest(box) < nearest) return false;
  for (const int offset : kRowOrder) {
    const int row = pixel.row + offset * step;
    if (row < box.top || row > box.bottom) continue;
    if (isCrossedBy({box.left, box.right, row, row}, voxel, nearest)) return true;
  }
  return false;
}

bool FrameCarver::isFree(const VoxelIndex& voxel, const ViewPoint& center,
                         const LatticeProjection::CenterPixel& pixel) const {
  if (carving_ == Carving::kFast) return isFreeNearCenter(voxel, center, pixel);
  const float half = projection_.corners(3).depth + depth_slack_;
  const float nearest = center.z - half;
  if (center.z + half <= 0.0F || nearest >= depth_.largest()) return false;
  PixelBox box;
  if (projection_.boxOf(center, 3, box) == Coverage::kNone) return false;
  if (depth_.farthest(box) < nearest) return false;
  return isCrossed(voxel, center, nearest, box);
}

/// Divides large boxes, which only voxels close to the camera have, to leave most of them out.
bool FrameCarver::isCrossed(const VoxelIndex& voxel, const ViewPoint& center, float nearest,
                            const PixelBox& box) const {
  const int width = box.right - box.left + 1;
  const int height = box.bottom - box.top + 1;
  if (width <= kUndivided && height <= kUndivided) return isCrossedBy(box, voxel, nearest);
  PixelBox first = box;
  PixelBox second = box;
  if (width > height) {
    first.right = box.left + width / 2 - 1;
    second.left = first.right + 1;
  } else {
    first.bottom = box.top + height / 2 - 1;
    second.top = first.bottom + 1;
  }
  const auto may_cross = [&](const PixelBox& part) {
    return depth_.farthest(part) >= nearest && projection_.mayCross(center, 3, part);
  };
  return (may_cross(first) && isCrossed(voxel, center, nearest, first)) ||
         (may_cross(second) && isCrossed(voxel, center, nearest, second));
}

bool FrameCarver::isCrossedBy(const PixelBox& box, const VoxelIndex& voxel, float nearest) const {
  const auto& inverse = rays_->inverse();
  const float x = static_cast<float>(voxel.x) - origin_[0];
  const float y = static_cast<float>(voxel.y) - origin_[1];
  const float z = static_cast<float>(voxel.z) - origin_[2];
  const float shortest = carving_ == Carving::kFast ? kShortestPass : 0.0F;
  for (int row = box.top; row <= box.bottom; ++row) {
    const auto start = static_cast<std::size_t>(row) * static_cast<std::size_t>(rays_->width());
    // The last rays may be those of pixels beyond the box: they are rays all the same.
    for (int column = box.left; column <= box.right; column += kRaysAtOnce) {
      const std::size_t first = start + static_cast<std::size_t>(column);
      if (at(rays_->depth(), first).maxCoeff() < nearest) continue;
      Float8 near = x * at(inverse[0], first);
      Float8 far = near + at(inverse[0], first);
      Float8 enter = near.min(far).max(0.0F);
      Float8 leave = near.max(far);
      near = y * at(inverse[1], first);
      far = near + at(inverse[1], first);
      enter = enter.max(near.min(far));
      leave = leave.min(near.max(far));
      near = z * at(inverse[2], first);
      far = near + at(inverse[2], first);
      enter = enter.max(near.min(far));
      leave = leave.min(near.max(far));
      if ((leave - enter).min(1.0F - leave).maxCoeff() > shortest) return true;
    }
  }
  return false;
}

}  // namespace occusg
