// SPDX-License-Identifier: BSD-3-Clause
#include "mask_source.hpp"

#include <opencv2/imgcodecs.hpp>

#include "occusg/error.hpp"
#include "occusg/io/object_labels.hpp"
#include "occusg/perception/class_names.hpp"
#include "occusg/perception/label_image.hpp"
#include "occusg/perception/onnx_segmenter.hpp"

namespace occusg::apps {
namespace {

InstanceMasks noMasks(const Frame& frame) {
  InstanceMasks masks;
  masks.image_size = frame.depth.pixels.size();
  return masks;
}

}  // namespace

MaskSource::MaskSource(const SequenceReader& sequence) {
  if (const auto path = sequence.truthPath()) label_of_object_ = readObjectLabels(*path);
}

MaskSource::MaskSource(const std::string& model_path, const std::string& classes_path) {
  OnnxSegmenterConfig config;
  config.model_path = model_path;
  config.class_names = readClassNames(classes_path);
  segmenter_ = std::make_unique<OnnxSegmenter>(config);
}

InstanceMasks MaskSource::masksOf(const Frame& frame) {
  if (segmenter_) {
    if (!frame.color_path) return noMasks(frame);
    const cv::Mat image = cv::imread(*frame.color_path, cv::IMREAD_COLOR);
    if (image.empty())
      throw refuse(*frame.color_path, "cannot be read", "a colour image is needed");
    return segmenter_->segment(image);
  }
  if (!frame.label_path || label_of_object_.empty()) return noMasks(frame);
  return occusg::masksOf(readLabelImage(*frame.label_path), label_of_object_);
}

}  // namespace occusg::apps
