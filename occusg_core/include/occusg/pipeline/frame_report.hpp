// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "occusg/geometry/cell.hpp"
#include "occusg/perception/depth_projector.hpp"

namespace occusg {

/// Whether a frame was used, or why it was not. A frame that was not used leaves nothing behind.
enum class FrameVerdict {
  kUsed,
  kWithoutDepth,  ///< No pixel has a usable depth.
  kFromOccupied,  ///< The camera would stand in an occupied voxel.
  kMapIsFull,     ///< The map has reached `max_memory_mb`.
  kOutsideMap,    ///< The camera would stand where the map cannot reach.
  kBeyondSpan,    ///< The free-space layer cannot span so much.
  kTooFast,       ///< The pose is farther from the last one than `max_speed_m_s` allows.
};

/// The outcome of one frame.
struct FrameReport {
  FrameVerdict verdict = FrameVerdict::kUsed;
  CellBox changed;                     ///< Bounds of the changed cells of the free-space layer.
  CellBox gaps_changed;                ///< Bounds of the cells whose gap changed likewise.
  std::size_t changed_columns = 0;     ///< Columns of the map in which a voxel became known.
  std::size_t points = 0;              ///< Surface points of the depth image.
  std::size_t points_outside_map = 0;  ///< Of them, those the map cannot reach.
  PixelDrops pixel_drops;              ///< Pixels that gave no point, by reason.
  bool rooms_updated = false;          ///< Whether regions and rooms were brought up to date.

  [[nodiscard]] bool isUsed() const { return verdict == FrameVerdict::kUsed; }
  /// Whether the pose can be the camera's; nothing follows from a frame whose pose cannot.
  [[nodiscard]] bool hasUsablePose() const {
    return verdict != FrameVerdict::kOutsideMap && verdict != FrameVerdict::kBeyondSpan &&
           verdict != FrameVerdict::kTooFast;
  }
};

/// One sentence for a verdict other than used, such as "the camera would be inside an obstacle".
[[nodiscard]] std::string sentenceOn(FrameVerdict verdict);

}  // namespace occusg
