// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "occusg/perception/depth_frame.hpp"
#include "occusg/perception/map_orientation.hpp"

namespace occusg_ros {

/// Looks at some of the first frames whether the map can lie as it does: z up, the floor near z =
/// 0.
class OrientationCheck {
 public:
  /// Takes one frame a second of its stamps, until it has seen enough.
  /// @throws occusg::Error when the frame cannot be projected.
  void add(const occusg::DepthFrame& frame);

  [[nodiscard]] bool isDone() const { return samples_ == kSamples; }
  /// What looks wrong, as a sentence; empty when nothing does, or nothing was seen.
  [[nodiscard]] std::string doubt() const;

 private:
  static constexpr std::size_t kSamples = 30;

  occusg::MapOrientationEstimator estimator_;
  std::size_t samples_ = 0;
  double last_s_ = 0.0;
};

}  // namespace occusg_ros
