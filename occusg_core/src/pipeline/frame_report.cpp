// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/frame_report.hpp"

namespace occusg {

std::string sentenceOn(FrameVerdict verdict) {
  switch (verdict) {
    case FrameVerdict::kUsed:
      return "the frame was used";
    case FrameVerdict::kWithoutDepth:
      return "not one pixel has a depth";
    case FrameVerdict::kFromOccupied:
      return "the camera would be inside an obstacle; the pose or the map is wrong there";
    case FrameVerdict::kMapIsFull:
      return "the map has reached mapping/occupancy/max_memory_mb; reset it or raise it";
    case FrameVerdict::kOutsideMap:
      return "the camera is farther away than the map reaches; choose a nearer origin";
    case FrameVerdict::kBeyondSpan:
      return "the map would become wider than its free-space layer can be";
    case FrameVerdict::kTooFast:
      return "its pose is farther from the last one than a robot gets in that time";
  }
  return "";
}

}  // namespace occusg
