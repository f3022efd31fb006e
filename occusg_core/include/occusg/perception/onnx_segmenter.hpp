// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "occusg/parameter.hpp"
#include "occusg/perception/instance_segmenter.hpp"

namespace occusg {

/// How a segmentation model is run.
struct OnnxSegmenterConfig {
  std::string model_path;
  std::vector<std::string> class_names;  ///< In the order of the class ids.
  int input_side = 640;  ///< Of models that take any size: square input [pixels], [32, 4096].
  double min_confidence = 0.70;  ///< Instances of a lower score are left out, (0, 1].
  double max_iou = 0.45;         ///< Of overlapping boxes of a class the better stays, [0, 1].
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(OnnxSegmenterConfig& config);

/// An ONNX segmentation model of the YOLO family on the CPU, through OpenCV's DNN module. Both
/// layouts of `YoloLayout` are understood, and told apart by their shapes. One image at a time, not
/// from several threads.
class OnnxSegmenter : public InstanceSegmenter {
 public:
  /// Loads the model and runs it once on a grey image, so that a model that cannot be used is
  /// refused here and not at the first frame.
  /// @throws Error naming file, and layer or shape: unreadable, not ONNX, a layer OpenCV does not
  /// know, not one image input, not two outputs, shapes that fit neither layout, another number of
  /// classes than names; or the field that is out of its range.
  explicit OnnxSegmenter(const OnnxSegmenterConfig& config);
  OnnxSegmenter(const OnnxSegmenter&) = delete;
  OnnxSegmenter(OnnxSegmenter&&) = delete;
  OnnxSegmenter& operator=(const OnnxSegmenter&) = delete;
  OnnxSegmenter& operator=(OnnxSegmenter&&) = delete;
  ~OnnxSegmenter() override;

  [[nodiscard]] InstanceMasks segment(const cv::Mat& image) override;

 private:
  class Network;

  OnnxSegmenterConfig config_;
  std::unique_ptr<Network> network_;
};

}  // namespace occusg
