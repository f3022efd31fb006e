// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/what_is_there.hpp"
#include "scene_graph_node.hpp"

namespace occusg_ros {
void SceneGraphNode::checkHealth() {
  const CallbackTimes::Timing timing(callbacks_, "health");
  diagnostics_.force_update();
  clock_.warn(handles_.name);
  const InputHealth::Counts counts = health_.counts();
  if (counts.used > 0) return;
  std::string problem = counts.last_problem;
  if (problem.empty()) {
    const std::lock_guard<std::mutex> lock(mutex_);
    problem = pose_problem_;
  }
  const std::string missing =
      missing_input_.toSay({{"free space", grid_subscriber_.getTopic(), counts.received,
                             grid_subscriber_.getNumPublishers()}},
                           problem, steadySeconds() - started_s_);
  if (missing.empty()) return;
  const std::string instead =
      counts.received == 0 ? publishedInstead(grid_subscriber_.getTopic(), "nav_msgs/OccupancyGrid")
                           : framesInstead(tf_);
  ROS_WARN_STREAM(handles_.name << ": there is no scene graph: " << missing << instead);
}

void SceneGraphNode::describe(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  const InputHealth::Counts counts = health_.counts();
  Status graph;
  std::size_t detections = 0;
  std::size_t refused_detections = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    graph = status_;
    detections = detections_received_;
    refused_detections = detections_refused_;
  }
  const std::string clock_problem = clock_.problem();
  const std::size_t not_used = counts.of(Drop::kImage) + counts.of(Drop::kStamp) +
                               counts.of(Drop::kMap) + counts.of(Drop::kNoTransform);
  if (!clock_problem.empty()) {
    status.summary(Level::ERROR, clock_problem);
  } else if (counts.received == 0) {
    status.summary(Level::WARN, "no free space yet");
  } else if (counts.used == 0) {
    status.summary(Level::ERROR, "no free space could be used: " + counts.last_problem);
  } else if (!paused_ && 2 * not_used > counts.received) {
    status.summary(Level::WARN, "more than half of the maps are dropped: " + counts.last_problem);
  } else if (!paused_ && 2 * refused_detections > detections) {
    status.summary(Level::WARN, "more than half of the detections are refused");
  } else if (!paused_ && graph.rooms == 0) {
    status.summary(Level::WARN, "no rooms: " + graph.why_no_rooms);
  } else {
    status.summary(Level::OK, paused_ ? "paused" : std::to_string(graph.rooms) + " rooms");
  }
  if (!graph.assumption.empty()) status.add("assumed", graph.assumption);
  status.add("maps received", counts.received);
  status.add("maps used", counts.used);
  status.add("maps used without their overhead gaps", graph.maps_without_gaps);
  status.add("age of the last used map [s]",
             counts.used > 0 ? steadySeconds() - counts.last_used_s : -1.0);
  for (const Drop drop : {Drop::kImage, Drop::kStamp, Drop::kOverload, Drop::kMap, Drop::kPaused})
    status.add("dropped: " + nameOf(drop), counts.of(drop));
  status.add("last problem", counts.last_problem);
  status.add("region updates", graph.counts.region_updates);
  status.add("region updates rejected", graph.counts.rejected_region_updates);
  status.add("rooms", graph.rooms);
  status.add("nodes", graph.nodes);
  status.add("edges", graph.edges);
  status.add("detections received", detections);
  status.add("detections refused", refused_detections);
  for (const auto& [stage, times] : graph.times) {
    status.add(stage + " p50 [ms]", times.p50_ms);
    status.add(stage + " p95 [ms]", times.p95_ms);
    status.add(stage + " max [ms]", times.max_ms);
  }
  callbacks_.describe(status);
  graph.saves.describe(status, steadySeconds());
}

}  // namespace occusg_ros
