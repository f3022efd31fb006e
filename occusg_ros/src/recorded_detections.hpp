// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <occusg/DetectionArray.h>
#include <ros/time.h>

#include <map>
#include <optional>
#include <string>

#include "occusg/io/sequence_reader.hpp"
#include "occusg/perception/detection_builder.hpp"

namespace occusg_ros {

/// What a recording's label images show, as a detector would send it.
class RecordedDetections {
 public:
  /// @throws occusg::Error when the recording's `rooms.json` cannot be read.
  explicit RecordedDetections(const occusg::SequenceReader& sequence);

  /// Whether the recording names objects.
  [[nodiscard]] bool any() const { return !label_of_object_.empty(); }

  /// The detections of a frame in the map frame; empty when the frame has no label image.
  /// @param stamp of the message, whatever the frame's own is.
  /// @throws occusg::Error when the label image cannot be used.
  [[nodiscard]] std::optional<occusg::DetectionArray> of(const occusg::Frame& frame,
                                                         const ros::Time& stamp,
                                                         const std::string& map_frame) const;

 private:
  std::map<int, std::string> label_of_object_;
  occusg::DetectionBuilder builder_;
};

}  // namespace occusg_ros
