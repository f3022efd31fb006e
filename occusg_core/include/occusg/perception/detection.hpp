// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

#include "occusg/perception/instance_mask.hpp"

namespace occusg {

/// An object seen in one frame, placed in the map.
struct Detection {
  double stamp_s = 0.0;  ///< Of the depth image.
  int class_id = -1;
  std::string class_name;
  double score = 0.0;                                  ///< Confidence, 0..1.
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< Mean of its points, map frame [m].
  Eigen::AlignedBox3d box;                             ///< Of its points, along the map's axes [m].
  std::size_t point_count = 0;                         ///< Depth pixels it was made from.
  int source_object_id = 0;  ///< The object's id in a labelled recording; 0: there is none.
};

/// The detections of one frame, and what did not become one.
struct DetectionResult {
  std::vector<Detection> detections;  ///< In the order of the masks.
  RefusedMasks refused;               ///< Of the segmenter and of the builder.
};

}  // namespace occusg
