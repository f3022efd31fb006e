// SPDX-License-Identifier: BSD-3-Clause
// The parameters of this module: names, units, ranges, what they mean, and the paper's values.
#include "occusg/perception/depth_projector.hpp"
#include "occusg/perception/detection_builder.hpp"
#include "occusg/perception/onnx_segmenter.hpp"
#include "occusg/perception/pose_gate.hpp"

namespace occusg {
namespace {

constexpr double kLongest_m = 1000.0;

}  // namespace

std::vector<Parameter> parametersOf(DepthProjectorConfig& depth) {
  std::vector<Parameter> list;
  list.push_back(countParameter(depth.stride, {1, kMaxImageSide},
                                {"perception.depth.stride", "pixels",
                                 "Only every n-th pixel is used, in both directions.", "2"}));
  list.push_back(numberParameter(
      depth.min_depth_m, {0.0, kLongest_m},
      {"perception.depth.min_depth_m", "m", "Depth pixels nearer than this are dropped.", "0.01"}));
  list.push_back(numberParameter(depth.max_depth_m, {0.0, kLongest_m},
                                 {"perception.depth.max_depth_m", "m",
                                  "Depth pixels farther than this show no surface.", "10"}));
  list.push_back(choiceParameter<BeyondMaxDepth>(
      depth.beyond_max_depth, {{"drop", BeyondMaxDepth::kDrop}, {"clear", BeyondMaxDepth::kClear}},
      {"perception.depth.beyond_max_depth", "",
       "What a pixel beyond the maximum depth means: nothing, or free space up to there.",
       "drop"}));
  list.push_back(numberParameter(
      depth.max_plausible_depth_m, {0.1, 1e5},
      {"perception.depth.max_plausible_depth_m", "m",
       "Depth values above this (and above max_depth_m) cannot be measurements and are ignored."}));
  return list;
}

std::vector<Parameter> parametersOf(PoseGateConfig& poses) {
  std::vector<Parameter> list;
  list.push_back(numberParameter(poses.max_speed_m_s, {0.1, 1e4},
                                 {"perception.poses.max_speed_m_s", "m/s",
                                  "Highest plausible speed of the camera; a frame whose pose would "
                                  "need more (with 1 m of tolerance) is ignored."}));
  return list;
}

std::vector<Parameter> parametersOf(DetectionBuilderConfig& detection) {
  std::vector<Parameter> list;
  list.push_back(numberParameter(
      detection.cluster_eps_m, {0.005, 10.0},
      {"perception.objects.cluster_eps_m", "m",
       "Points of one object are clustered when they are at most this far apart.", "0.05"}));
  list.push_back(numberParameter(detection.cluster_gap_pixels, {0.0, 100.0},
                                 {"perception.objects.cluster_gap_pixels", "pixels",
                                  "Points of one object are also clustered when they are at most "
                                  "this many pixels apart at their depth, up to 0.5 m.",
                                  "0"}));
  list.push_back(countParameter(detection.min_cluster_points, {1, 1000000},
                                {"perception.objects.min_points", "pixels",
                                 "Minimum number of depth pixels in the largest cluster of an "
                                 "object; with fewer, the detection is refused.",
                                 "50"}));
  list.push_back(numberParameter(detection.max_depth_m, {0.01, kLongest_m},
                                 {"perception.objects.max_depth_m", "m",
                                  "Pixels of an object farther than this are not used.", "10"}));
  list.push_back(countParameter(
      detection.max_masks, {1, static_cast<int>(kMaxMasks)},
      {"perception.objects.max_masks", "masks",
       "Maximum number of objects used per image; those with the best scores are kept."}));
  return list;
}

std::vector<Parameter> parametersOf(OnnxSegmenterConfig& segmenter) {
  std::vector<Parameter> list;
  list.push_back(numberParameter(
      segmenter.min_confidence, {0.001, 1.0},
      {"perception.model.min_confidence", "",
       "Minimum score of the segmentation model; objects with a lower score are left out.",
       "0.7"}));
  list.push_back(numberParameter(
      segmenter.max_iou, {0.0, 1.0},
      {"perception.model.max_iou", "",
       "When two boxes of one class overlap by more than this IoU, only the better one is kept.",
       "0.45"}));
  list.push_back(countParameter(segmenter.input_side, {32, 4096},
                                {"perception.model.input_side", "pixels",
                                 "Side of the input image for models that accept any size."}));
  return list;
}

}  // namespace occusg
