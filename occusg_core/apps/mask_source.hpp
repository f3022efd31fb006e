// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "occusg/io/sequence_reader.hpp"
#include "occusg/perception/instance_segmenter.hpp"
#include "occusg/perception/onnx_segmenter.hpp"

namespace occusg::apps {

/// Where the objects of a recording come from: a model that segments its colour images, or else its
/// label images, if it has them.
class MaskSource {
 public:
  /// Label images, when the recording's `rooms.json` names their objects.
  explicit MaskSource(const SequenceReader& sequence);
  /// A segmentation model on the colour images.
  explicit MaskSource(const OnnxSegmenterConfig& model);

  /// The objects in the frame; none when there is no image to find them in.
  /// @throws Error when the image cannot be used.
  [[nodiscard]] InstanceMasks masksOf(const Frame& frame);

 private:
  std::unique_ptr<InstanceSegmenter> segmenter_;
  std::map<int, std::string> label_of_object_;
};

}  // namespace occusg::apps
