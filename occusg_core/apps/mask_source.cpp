// SPDX-License-Identifier: BSD-3-Clause
#include "mask_source.hpp"

#include <opencv2/imgcodecs.hpp>

#include "occusg/error.hpp"
#include "occusg/io/color_image.hpp"
#include "occusg/io/object_labels.hpp"
#include "occusg/perception/detection_builder.hpp"
#include "occusg/perception/instance_mask.hpp"

namespace occusg::apps {
namespace {

/// @throws Error unless the image shows what the depth image shows.
void checkSize(const cv::Mat& image, const std::string& path, const Frame& frame) {
  const cv::Size depth = frame.depth.pixels.size();
  if (isSameView(image.size(), depth)) return;
  throw refuse(path,
               "is " + std::to_string(image.cols) + " x " + std::to_string(image.rows) + " pixels",
               "the aspect ratio of the depth image, " + std::to_string(depth.width) + " x " +
                   std::to_string(depth.height) + ", is needed");
}

InstanceMasks noMasks(const Frame& frame) {
  InstanceMasks masks;
  masks.image_size = frame.depth.pixels.size();
  return masks;
}

}  // namespace

MaskSource::MaskSource(const SequenceReader& sequence) {
  if (const auto path = sequence.truthPath()) label_of_object_ = readObjectLabels(*path);
}

MaskSource::MaskSource(const OnnxSegmenterConfig& model)
    : segmenter_(std::make_unique<OnnxSegmenter>(model)) {}

InstanceMasks MaskSource::masksOf(const Frame& frame) {
  if (segmenter_) {
    if (!frame.color_path) return noMasks(frame);
    const cv::Mat image = readColorImage(*frame.color_path);
    checkSize(image, *frame.color_path, frame);
    return segmenter_->segment(image);
  }
  if (!frame.label_path || label_of_object_.empty()) return noMasks(frame);
  const cv::Mat object_ids = readLabelImage(*frame.label_path);
  checkSize(object_ids, *frame.label_path, frame);
  return occusg::masksOf(object_ids, label_of_object_);
}

}  // namespace occusg::apps
