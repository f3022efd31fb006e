// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_detections.hpp"

#include "occusg/io/object_labels.hpp"
#include "occusg/perception/instance_mask.hpp"
#include "occusg_ros/graph_conversions.hpp"

namespace occusg_ros {

RecordedDetections::RecordedDetections(const occusg::SequenceReader& sequence)
    : builder_(occusg::DetectionBuilderConfig{}) {
  if (const auto path = sequence.truthPath()) label_of_object_ = occusg::readObjectLabels(*path);
}

std::optional<occusg::DetectionArray> RecordedDetections::of(const occusg::Frame& frame,
                                                             const ros::Time& stamp,
                                                             const std::string& map_frame) const {
  if (!frame.label_path || !any()) return std::nullopt;
  const occusg::InstanceMasks masks =
      occusg::masksOf(occusg::readLabelImage(*frame.label_path), label_of_object_);
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = map_frame;
  return toDetectionMsg(builder_.build(masks, frame).detections, header);
}

}  // namespace occusg_ros
