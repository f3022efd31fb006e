// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "occusg/perception/instance_mask.hpp"
#include "perception/letterbox.hpp"

namespace occusg {

/// How a segmentation network lays out its predictions. All come with prototypes
/// 1 x coefficients x height x width, and boxes in pixels of the network's input.
enum class YoloLayout {
  /// 1 x (4 + classes + coefficients) x anchors: box centre and size, a score per class, mask
  /// coefficients (YOLOv8, YOLO11). Overlapping boxes are to be suppressed.
  kAnchors,
  /// 1 x anchors x (5 + classes + coefficients): box centre and size, a score for there being any
  /// object, a score per class given that there is one, mask coefficients (YOLOv5, which OpenCV 4.2
  /// to 4.6 can load, too). Overlapping boxes are to be suppressed.
  kAnchorsWithObjectness,
  /// 1 x rows x (6 + coefficients): two box corners, score, class, mask coefficients (YOLO26).
  kEndToEnd,
};

/// Which layout the two outputs of a network have.
/// @param where opens every sentence; the model's path.
/// @throws Error giving the shapes when they fit no layout, or when the number of classes is
/// not `class_count`.
[[nodiscard]] YoloLayout layoutOf(const cv::Mat& predictions, const cv::Mat& prototypes,
                                  std::size_t class_count, const std::string& where);

/// One instance in the pixels of the network's input.
struct YoloInstance {
  cv::Rect2d box;
  int class_id = -1;
  float score = 0.0F;
  cv::Mat coefficients;  ///< 1 x n floats.
};

struct YoloInstances {
  std::vector<YoloInstance> instances;  ///< Best score first; ties in the order of the network.
  RefusedMasks refused;  ///< Not finite or without an area, and those beyond `kMaxMasks`.
};

struct YoloDecoding {
  YoloLayout layout = YoloLayout::kAnchors;
  double min_confidence = 0.70;
  double max_iou =
      0.45;  ///< Not of kEndToEnd: of two boxes of a class that overlap more, the better stays.
};

/// Reads the instances off the predictions. At most the 3000 best candidates take part in the
/// suppression.
/// @param coefficient_count channels of the prototypes.
/// @pre `layoutOf` accepted the shapes.
[[nodiscard]] YoloInstances decodeYolo(const cv::Mat& predictions, int coefficient_count,
                                       const YoloDecoding& decoding);

/// The instance's mask in the image: where the sum of the prototypes weighted with the
/// coefficients, interpolated, is above 0 (its sigmoid above 0.5), cropped to the box. Class name
/// and id of the mask are left to the caller. An instance outside the image has a mask with an
/// empty box.
[[nodiscard]] InstanceMask maskInImage(const YoloInstance& instance, const cv::Mat& prototypes,
                                       const Letterbox& letterbox);

}  // namespace occusg
