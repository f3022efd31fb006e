// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "occusg/parameter.hpp"
#include "occusg/perception/depth_frame.hpp"
#include "occusg/perception/detection.hpp"
#include "occusg/perception/instance_mask.hpp"

namespace occusg {

/// Which instance masks become detections.
struct DetectionBuilderConfig {
  double cluster_eps_m = 0.05;  ///< Points nearer than this belong together [m], [0.005, 10].
  /// So do points nearer than this many pixels at the mask's depth, up to 0.5 m, [0, 100]. Far
  /// surfaces are sampled more coarsely than `cluster_eps_m`: on one seen at an angle of a the
  /// pixels are 1 / sin a apart, six at 10 degrees (the adaptive breakpoint of Borges and Aldon,
  /// "Line extraction in 2D range images for mobile robotics", 2004).
  double cluster_gap_pixels = 6.0;
  int min_cluster_points = 50;  ///< Fewest depth pixels of a detection, at least 1.
  double max_depth_m = 10.0;    ///< Farther pixels are not used, along the optical axis [m].
  int max_masks = kMaxMasks;    ///< Most masks of a frame; those of the best score, >= 1.
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(DetectionBuilderConfig& config);

/// Whether masks of an image of this size can belong to a depth image of that size: it has sides in
/// [1, 16384] pixels and the aspect ratio of the depth image.
[[nodiscard]] bool isSameView(const cv::Size& image, const cv::Size& depth);

/// Instance masks and the depth image of the same view -> 3D detections (paper, Sec. 3.2): the
/// depth pixels under a mask are back-projected, and the largest Euclidean cluster (Rusu 2009,
/// "Semantic 3D Object Maps for Everyday Manipulation") is the object.
///
/// The masks' image must be registered to the depth image: same view, any resolution. A depth pixel
/// belongs to a mask when its centre does. Depth counts when it is finite, above 1 mm and not
/// saturated. Dense points are thinned to one per voxel of side eps / 2.5 before clustering, so
/// that a mask of the whole image stays fast; counts, centroid and box are those of all points.
class DetectionBuilder {
 public:
  /// @throws Error naming the field, its value and the range.
  explicit DetectionBuilder(const DetectionBuilderConfig& config);

  /// Equal input gives equal output. A mask that cannot be used is refused and counted.
  /// @throws Error when the frame itself cannot be used: camera, depth image, pose or stamp are not
  /// valid, or the masks' image has another aspect ratio than the depth image.
  [[nodiscard]] DetectionResult build(const InstanceMasks& masks, const DepthFrame& frame) const;

 private:
  DetectionBuilderConfig config_;
};

}  // namespace occusg
