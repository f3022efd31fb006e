// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/depth_bounds.hpp"
#include "mapping/frame_rays.hpp"
#include "mapping/frame_voxels.hpp"
#include "mapping/lattice_projection.hpp"
#include "mapping/settled_voxels.hpp"

namespace occusg {

/// How thoroughly the voxels at the rim of what a frame saw free are looked at.
enum class Carving {
  kExact,  ///< Free is what any ray crosses.
  kFast,   ///< Free is what a ray crosses that passes close to the voxel's centre.
};

/// Finds the voxels a frame saw free or occupied without walking along its rays: cubes of voxels
/// are projected onto the pixel lattice. Where all rays that can cross a cube end beyond it, it is
/// free; where all end before it, it is not; else its eight parts are looked at, and in the end the
/// rays through a voxel are tested one by one.
class FrameCarver {
 public:
  /// @param settled of the map: voxels the frame leaves as they are are left out.
  /// @return the touched blocks in Morton order, as `VoxelTree::integrate` wants them; valid until
  /// the next call.
  const std::vector<VoxelBlock>& carve(const FrameRays& rays, const RangeImage& image,
                                       const SettledVoxels& settled, Carving carving,
                                       Workers& workers);
  /// Blocks between the bounds of the rays. Time and memory of `carve` grow with it.
  [[nodiscard]] static std::size_t blocksBetween(const std::array<VoxelIndex, 2>& bounds);

 private:
  struct Window {
    VoxelIndex first;  ///< Block, world-aligned.
    VoxelIndex size;   ///< Blocks.
  };
  /// A block under the knife.
  struct Block {
    VoxelIndex first_voxel;
    std::array<std::uint64_t, 8> done{};  ///< Voxels that need no look.
    std::array<std::uint64_t, 8> free{};
  };
  enum class Verdict { kNone, kSome, kAll };
  struct Judgement {
    Verdict verdict = Verdict::kNone;
    float farthest = 0.0F;  ///< Where the rays that can cross the cube end, at most.
  };

  void openFrame(const FrameRays& rays, const RangeImage& image);
  void openWindow(const std::array<VoxelIndex, 2>& bounds);
  void mark(const FrameRays& rays);
  void carveBlocks(int first_row, int end_row, std::vector<VoxelBlock>& carved);
  void carveBlock(const VoxelIndex& at, const ViewPoint& center, std::vector<VoxelBlock>& carved);
  void sortBlocks();
  void carveWord(Block& block, unsigned word, const ViewPoint& center) const;
  [[nodiscard]] std::uint64_t carveByte(const Block& block, unsigned word, unsigned byte,
                                        const ViewPoint& center) const;
  [[nodiscard]] bool isFree(const VoxelIndex& voxel, const ViewPoint& center,
                            const LatticeProjection::CenterPixel& pixel) const;
  [[nodiscard]] float endAt(const LatticeProjection::CenterPixel& pixel) const;
  [[nodiscard]] bool isFreeNearCenter(const VoxelIndex& voxel, const ViewPoint& center,
                                      const LatticeProjection::CenterPixel& pixel) const;
  [[nodiscard]] bool isCrossed(const VoxelIndex& voxel, const ViewPoint& center, float nearest,
                               const PixelBox& box) const;
  [[nodiscard]] bool isCrossedBy(const PixelBox& box, const VoxelIndex& voxel, float nearest) const;
  [[nodiscard]] Judgement judge(const ViewPoint& center, std::size_t size) const;

  Carving carving_ = Carving::kExact;
  const FrameRays* rays_ = nullptr;
  const SettledVoxels* settled_ = nullptr;
  LatticeProjection projection_;
  DepthBounds depth_;
  float depth_slack_ = 0.0F;  ///< Rounding of depths [voxels].
  std::array<float, 3> origin_{};
  Window window_;
  std::vector<std::uint32_t> slots_;  ///< Of the window's blocks: number of the mark + 1, or 0.
  std::vector<VoxelBlock> marked_;    ///< What rays end in.
  std::vector<std::vector<VoxelBlock>> carved_;  ///< By task.
  std::vector<const VoxelBlock*> order_;
  std::vector<VoxelBlock> sorted_;
};

}  // namespace occusg
