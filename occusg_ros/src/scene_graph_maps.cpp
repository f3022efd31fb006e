// SPDX-License-Identifier: BSD-3-Clause
// How maps come into the scene graph: one grid, or the free space of each storey.
#include <boost/make_shared.hpp>
#include <exception>
#include <new>
#include <utility>

#include "occusg/error.hpp"
#include "occusg_ros/gap_conversions.hpp"
#include "occusg_ros/grid_conversions.hpp"
#include "occusg_ros/shown_text.hpp"
#include "occusg_ros/storey_conversions.hpp"
#include "occusg_ros/topic_names.hpp"
#include "scene_graph_node.hpp"

namespace occusg_ros {
namespace {

std::size_t indexOf(std::int32_t floor_id, const occusg::Building& building,
                    const std::string& where) {
  if (floor_id >= 0 && static_cast<std::size_t>(floor_id) < building.storeys.size())
    return static_cast<std::size_t>(floor_id);
  throw occusg::refuse(where, "is of the floor_id " + std::to_string(floor_id),
                       "the building has " + std::to_string(building.storeys.size()) + " storeys");
}

}  // namespace

// In a building of several storeys the layers of all of them come another way.
void SceneGraphNode::onGrid(const nav_msgs::OccupancyGridConstPtr& grid) {
  const CallbackTimes::Timing timing(callbacks_, "free space");
  if (has_mapped_storeys_) return;
  if (!takesMap(grid->header, grid_subscriber_.getTopic())) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    whole_grid_ = grid;
    if (waiting_.takeGrid(grid, steadySeconds())) health_.noteDropped(Drop::kOverload, "");
  }
  worker_->wake();
}

bool SceneGraphNode::takesMap(const std_msgs::Header& header, const std::string& topic) {
  health_.noteReceived();
  if (paused_) {
    health_.noteDropped(Drop::kPaused, "");
    return false;
  }
  return !refusesStamp(header.stamp, topic) && !refusesFrame(header.frame_id, topic);
}

bool SceneGraphNode::refusesFrame(const std::string& frame, const std::string& topic) {
  if (frameName(frame) == frameName(settings_.map_frame)) return false;
  const std::string problem = topic + ": its frame is '" + shownName(frame) + "'; ~map_frame is '" +
                              settings_.map_frame + "'";
  health_.noteDropped(Drop::kImage, problem);
  if (map_warnings_.allows()) ROS_WARN_STREAM(handles_.name << ": map not used: " << problem);
  return true;
}

void SceneGraphNode::onGridUpdate(const map_msgs::OccupancyGridUpdateConstPtr& update) {
  const CallbackTimes::Timing timing(callbacks_, "free space");
  nav_msgs::OccupancyGridConstPtr whole;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    whole = whole_grid_;
  }
  const std::string& topic = grid_update_subscriber_.getTopic();
  try {
    if (!whole)
      throw occusg::refuse(topic, "a part came before the map", "the whole map must come once");
    onGrid(boost::make_shared<const nav_msgs::OccupancyGrid>(updated(*whole, *update, topic)));
  } catch (const occusg::Error& error) {
    health_.noteReceived();
    health_.noteDropped(Drop::kImage, error.what());
    if (map_warnings_.allows())
      ROS_WARN_STREAM(handles_.name << ": map not used: " << shownText(error.what()));
  }
}

void SceneGraphNode::onGaps(const occusg::OverheadGapsConstPtr& gaps) {
  const CallbackTimes::Timing timing(callbacks_, "overhead gaps");
  if (paused_ || refusesStamp(gaps->header.stamp, gaps_subscriber_.getTopic())) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.takeGaps(gaps, steadySeconds());
  }
  worker_->wake();
}

void SceneGraphNode::onStoreyLayer(const occusg::StoreyFreeSpaceConstPtr& layer) {
  const CallbackTimes::Timing timing(callbacks_, "free space of a storey");
  if (!takesMap(layer->header, storey_subscriber_.getTopic())) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    StoreyLayerWaiting& waiting = waiting_storeys_[layer->floor_id];
    if (waiting.layer) health_.noteDropped(Drop::kOverload, "");
    waiting = {layer, steadySeconds()};
  }
  worker_->wake();
}

void SceneGraphNode::useMap(const std::function<void()>& use) {
  try {
    use();
    health_.noteUsed();
  } catch (const std::bad_alloc&) {
    onFailure({"no more memory for a map", true});
  } catch (const std::exception& error) {
    health_.noteDropped(Drop::kMap, error.what());
    if (map_warnings_.allows())
      ROS_WARN_STREAM(handles_.name << ": map not used: " << shownText(error.what()));
  }
}

bool SceneGraphNode::takeStoreyLayer() {
  StoreyLayerWaiting next;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    // The oldest first: a building never has fewer storeys than it had.
    for (const auto& [floor_id, waiting] : waiting_storeys_)
      if (!next.layer || waiting.layer->header.stamp < next.layer->header.stamp) next = waiting;
  }
  if (!next.layer) return false;
  const WaitingMap::Map map = next.map();
  const std::optional<occusg::Pose> pose = poseFor(map);
  if (!pose) return false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto waiting = waiting_storeys_.find(next.layer->floor_id);
    if (waiting != waiting_storeys_.end() && waiting->second.layer == next.layer)
      waiting_storeys_.erase(waiting);
  }
  useMap([&] {
    const std::string& topic = storey_subscriber_.getTopic();
    const occusg::Building building = toBuilding(next.layer->building, topic);
    const std::size_t storey = indexOf(next.layer->floor_id, building, topic);
    has_mapped_storeys_ = building.storeys.size() > 1;
    rooms_->follow(building);
    update(map, *pose, storey);
  });
  return true;
}

WaitingMap::Map SceneGraphNode::StoreyLayerWaiting::map() const {
  return {nav_msgs::OccupancyGridConstPtr(layer, &layer->grid),
          occusg::OverheadGapsConstPtr(layer, &layer->gaps), arrived_s};
}

occusg::MapView SceneGraphNode::viewOf(const occusg::FreeSpace& layer) {
  occusg::MapView view;
  view.layer = &layer;
  view.changed = layer.changed;
  view.gaps_changed = layer.gaps_changed;
  return view;
}

occusg::Pose SceneGraphNode::onItsStorey(const occusg::Pose& pose) const {
  return has_mapped_storeys_ ? pose : given_storeys_.onStorey(pose);
}

std::vector<occusg::Detection> SceneGraphNode::onTheirStorey(
    std::vector<occusg::Detection> detections) const {
  if (has_mapped_storeys_) return detections;
  for (occusg::Detection& detection : detections) {
    const double z_m = detection.centroid.z();
    const double rise_m = given_storeys_.heightOnStorey(z_m) - z_m;
    if (rise_m == 0.0) continue;
    detection.centroid.z() += rise_m;
    detection.box.translate(rise_m * Eigen::Vector3d::UnitZ());
  }
  return detections;
}

std::optional<WaitingMap::Map> SceneGraphNode::nextMap() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  // The first map comes after all is subscribed to; this thread was there before.
  if (waiting_.empty()) return std::nullopt;
  const GapsPublished published =
      gaps_subscriber_.getNumPublishers() > 0 ? GapsPublished::kYes : GapsPublished::kNo;
  return waiting_.ready(published, steadySeconds());
}

// The pose at the time of the map; after the timeout, or when the map is older than tf remembers,
// as a finished map is, the newest pose there is.
std::optional<occusg::Pose> SceneGraphNode::poseFor(const WaitingMap::Map& waiting) {
  PoseAnswer answer = robotPose(waiting.grid->header.stamp);
  const bool may_come = answer.kind == PoseAnswer::Kind::kNotYet &&
                        steadySeconds() - waiting.arrived_s < settings_.tf_timeout_s;
  if (answer.kind != PoseAnswer::Kind::kFound && !may_come) answer = robotPose(ros::Time());
  if (answer.kind == PoseAnswer::Kind::kFound) return answer.T_target_source;
  const std::lock_guard<std::mutex> lock(mutex_);
  pose_problem_ = answer.problem;
  return std::nullopt;
}

void SceneGraphNode::update(const WaitingMap::Map& map, const occusg::Pose& pose,
                            std::size_t storey) {
  layers_.resize(rooms_->storeyCount(), emptyLayer());
  occusg::FreeSpace& last = layers_[storey];
  const GridReading reading =
      readingOf(map.grid->data, {settings_.free_below_percent, occupiedAbove(settings_)});
  tellAssumption(reading.assumption);
  occusg::FreeSpace layer = toFreeSpace(*map.grid, grid_subscriber_.getTopic(), reading.values);
  if (map.gaps) addGaps(*map.gaps, gaps_subscriber_.getTopic(), layer);
  const bool is_comparable = layer.frame.resolution_m == last.frame.resolution_m;
  const occusg::CellBox box = layer.cells.box().including(last.cells.box());
  layer.changed = is_comparable ? layer.cells.differingFrom(last.cells) : box;
  layer.gaps_changed = is_comparable ? layer.evidence.differingFrom(last.evidence, box) : box;
  last = std::move(layer);
  last_pose_ = pose;
  rooms_->update(storey, viewOf(last), pose, timeline_.at(map.grid->header.stamp.toSec()));
  publish(map.grid->header);
  noteStatus();
}

void SceneGraphNode::tellAssumption(const std::string& assumption) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!assumption.empty() && status_.assumption.empty())
    ROS_WARN_STREAM(handles_.name << ": " << grid_subscriber_.getTopic() << ": " << assumption);
  status_.assumption = assumption;
}

}  // namespace occusg_ros
