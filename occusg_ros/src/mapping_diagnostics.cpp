// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "mapping_node.hpp"
#include "occusg_ros/what_is_there.hpp"

namespace occusg_ros {
namespace {

constexpr double kOld_s = 5.0;
constexpr double kBytesPerMebibyte = 1024.0 * 1024.0;

/// Not counting what gave way to a newer image, which is as it should be on a slow machine.
bool mostAreDropped(const InputHealth::Counts& counts) {
  constexpr std::size_t kFewest = 20;
  const std::size_t dropped =
      counts.droppedInAll() - counts.of(Drop::kOverload) - counts.of(Drop::kPaused);
  return counts.received >= kFewest && 2 * dropped > counts.received;
}

}  // namespace

void MappingNode::checkHealth() {
  const CallbackTimes::Timing timing(callbacks_, "health");
  diagnostics_.force_update();
  clock_.warn(handles_.name);
  const InputHealth::Counts counts = health_.counts();
  if (counts.used > 0) return;
  const std::string missing =
      missing_input_.toSay({{"depth image", image_subscriber_.getTopic(), counts.received,
                             image_subscriber_.getNumPublishers()},
                            {"camera_info", info_subscriber_.getTopic(), infos_received_,
                             info_subscriber_.getNumPublishers()}},
                           counts.last_problem.empty() ? tfProblem() : counts.last_problem,
                           steadySeconds() - started_s_);
  if (missing.empty()) return;
  std::string instead;
  if (counts.received == 0)
    instead += publishedInstead(image_subscriber_.getTopic(), "sensor_msgs/Image");
  if (infos_received_ == 0)
    instead += publishedInstead(info_subscriber_.getTopic(), "sensor_msgs/CameraInfo");
  if (counts.received > 0 && infos_received_ > 0) instead += framesInstead(tf_);
  ROS_WARN_STREAM(handles_.name << ": nothing is mapped: " << missing << instead);
}

void MappingNode::describe(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  const InputHealth::Counts counts = health_.counts();
  const double age_s = steadySeconds() - counts.last_used_s;
  Status map;
  std::string camera_frame;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    map = status_;
    camera_frame = camera_frame_;
  }
  const double mebibytes = static_cast<double>(map.map_bytes) / kBytesPerMebibyte;
  const std::string clock_problem = clock_.problem();
  if (!clock_problem.empty()) {
    status.summary(Level::ERROR, clock_problem);
  } else if (counts.received == 0) {
    status.summary(Level::WARN, "no depth image yet");
  } else if (counts.used == 0) {
    status.summary(Level::ERROR, "no depth image could be used: " + counts.last_problem);
  } else if (paused_) {
    status.summary(Level::OK, "paused");
  } else if (age_s > kOld_s && map.counts.frames_without_memory > 0) {
    status.summary(Level::ERROR, "the map is full: " + counts.last_problem);
  } else if (age_s > kOld_s) {
    status.summary(Level::WARN, "no usable depth image for " + std::to_string(age_s) + " s");
  } else if (mostAreDropped(counts)) {
    status.summary(Level::WARN, "more than half of the images are dropped: " + counts.last_problem);
  } else if (!map.doubt.empty()) {
    status.summary(Level::WARN, map.doubt);
  } else if (mebibytes > settings_.soft_memory_mib) {
    status.summary(Level::WARN, "the map is larger than soft_memory_mib");
  } else {
    status.summary(Level::OK, "mapping");
  }
  status.add("images received", counts.received);
  status.add("images used", counts.used);
  status.add("camera_infos received", infos_received_.load());
  status.add("image rate [Hz]",
             static_cast<double>(counts.received) / std::max(1.0, steadySeconds() - started_s_));
  status.add("age of the last used image [s]", counts.used > 0 ? age_s : -1.0);
  for (std::size_t i = 0; i < kDropCount; ++i)
    status.add("dropped: " + nameOf(static_cast<Drop>(i)), counts.dropped[i]);
  status.add("last problem", counts.last_problem);
  status.add("tf lag [s]",
             transformAge(tf_, settings_.map_frame, camera_frame, ros::Time::now()).value_or(-1.0));
  status.add("lag of the map [s]", map.last_lag_s);
  status.add("frame time p50 [ms]", map.frame_times.p50_ms);
  status.add("frame time p95 [ms]", map.frame_times.p95_ms);
  status.add("frame time max [ms]", map.frame_times.max_ms);
  status.add("map nodes", map.map_nodes);
  status.add("map memory [MiB]", mebibytes);
  status.add("points outside the map", map.counts.points_outside_map);
  status.add("frames misplaced", map.counts.framesMisplaced());
  status.add("frames outside the map", map.counts.frames_outside_map);
  status.add("frames too fast", map.counts.frames_too_fast);
  status.add("frames beyond the layer's span", map.counts.frames_beyond_span);
  status.add("frames from inside an obstacle", map.counts.frames_from_occupied);
  status.add("frames without depth", map.counts.frames_without_depth);
  status.add("frames without memory", map.counts.frames_without_memory);
  status.add("far islands cut off the loaded map", map.cut_islands);
  status.add("pixels: zero", map.counts.pixel_drops.zero);
  status.add("pixels: NaN", map.counts.pixel_drops.nan);
  status.add("pixels: infinite", map.counts.pixel_drops.infinite);
  status.add("pixels: negative", map.counts.pixel_drops.negative);
  status.add("pixels: implausible", map.counts.pixel_drops.implausible);
  callbacks_.describe(status);
  map.saves.describe(status, steadySeconds());
}

}  // namespace occusg_ros
