// SPDX-License-Identifier: BSD-3-Clause
#include <octomap/OcTree.h>
#include <ros/service.h>

#include <memory>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/io/output_folder.hpp"
#include "occusg/io/session_folder.hpp"
#include "occusg/pipeline/results.hpp"
#include "occusg_ros/saved_folder.hpp"
#include "scene_graph_node.hpp"

namespace occusg_ros {
namespace {

constexpr const char* kSessionFolder = "/session";

// A session has a map, and this node has none: occusg/mapping saves it beside the session, so that
// each of the two can save and load alone.
octomap::OcTree placeholderMap(double resolution_m) {
  octomap::OcTree tree(resolution_m);
  tree.updateNode(octomap::point3d(0.0F, 0.0F, 0.0F), false);
  return tree;
}

}  // namespace

std::string SceneGraphNode::folderOf(const std::string& name) const {
  return expandedFolder(settings_.save_folder) + "/" + checkedSaveName(name);
}

void SceneGraphNode::resetGraph() {
  rooms_ = std::make_unique<occusg::RoomPipeline>(config_);
  layer_ = {};
  layer_.frame.resolution_m = config_.occupancy.resolution_m;
  last_maintenance_s_.reset();
  std_msgs::Header header;
  header.stamp = ros::Time::now();
  header.frame_id = settings_.map_frame;
  publish(header);
  noteStatus();
}

std::string SceneGraphNode::save(const std::string& name) {
  const occusg::OutputFolder folder(folderOf(name));
  occusg::SessionState state;
  state.scene = settings_.scene;
  state.stamp_s = timeline_.last();
  state.T_map_camera = last_pose_;
  rooms_->saveTo(state);
  occusg::saveSession(folder.path() + kSessionFolder,
                      placeholderMap(config_.occupancy.resolution_m), state);
  for (const occusg::ResultFile& file :
       occusg::resultFiles(occusg::Findings{layer_, rooms_->graph(), config_.graph.rooms.floor_z_m,
                                            settings_.scene},
                           rooms_->times()))
    folder.write(file.name, file.bytes);
  return folder.path();
}

void SceneGraphNode::load(const std::string& name) {
  const occusg::Session session =
      occusg::loadSession(folderOf(name) + kSessionFolder, config_.occupancy);
  // Into a fresh one: a session that cannot be used leaves the live graph as it is.
  auto loaded = std::make_unique<occusg::RoomPipeline>(config_);
  loaded->resumeFrom(session.state);
  rooms_ = std::move(loaded);
  last_pose_ = session.state.T_map_camera;
  last_maintenance_s_.reset();
  timeline_.goOnAfter(session.state.stamp_s, ros::Time::now().toSec());
  // Without a node that maps, what is there is the map of the session too.
  if (settings_.mapping_node.empty() && !layer_.cells.empty()) {
    rooms_->update(layer_, layer_.cells.box(), last_pose_, timeline_.last());
  } else {
    layer_ = {};
    layer_.frame.resolution_m = config_.occupancy.resolution_m;
  }
  std_msgs::Header header;
  header.stamp = ros::Time::now();
  header.frame_id = settings_.map_frame;
  publish(header);
}

void SceneGraphNode::resume() {
  if (settings_.resume.empty()) return;
  try {
    load(settings_.resume);
    ROS_INFO_STREAM(handles_.name << ": goes on from the session " << folderOf(settings_.resume)
                                  << " with " << lastGraph()->rooms.size() << " rooms");
  } catch (const occusg::Error& error) {
    ROS_WARN_STREAM(handles_.name << ": begins without rooms: " << error.what());
  }
}

template <typename Service>
std::string SceneGraphNode::askMapping(const std::string& service,
                                       const typename Service::Request& request) const {
  if (settings_.mapping_node.empty()) return {};
  const std::string name = handles_.services.resolveName(settings_.mapping_node + "/" + service);
  if (!ros::service::exists(name, false)) return name + " is not there; see ~mapping_node";
  typename Service::Response response;
  typename Service::Request copy = request;
  if (!ros::service::call(name, copy, response)) return name + " did not answer";
  return response.success ? "" : response.message;
}

bool SceneGraphNode::onSave(occusg::SaveMap::Request& request,
                            occusg::SaveMap::Response& response) {
  const auto folder = std::make_shared<std::string>();
  std::string problem = onWorker([this, name = request.name, folder] { *folder = save(name); });
  if (problem.empty()) problem = askMapping<occusg::SaveMap>("save", request);
  response.success = problem.empty();
  response.message = problem.empty() ? "saved" : problem;
  response.folder = *folder;
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.last_save = problem.empty() ? response.folder : "failed: " + problem;
  return true;
}

bool SceneGraphNode::onLoad(occusg::LoadMap::Request& request,
                            occusg::LoadMap::Response& response) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.reset();
  }
  std::string problem = onWorker([this, name = request.name] { load(name); });
  if (problem.empty()) problem = askMapping<occusg::LoadMap>("load", request);
  response.success = problem.empty();
  response.message =
      problem.empty() ? std::to_string(lastGraph()->rooms.size()) + " rooms" : problem;
  return true;
}

bool SceneGraphNode::onReset(std_srvs::Trigger::Request& request,
                             std_srvs::Trigger::Response& response) {
  std::string problem = settings_.allow_reset ? "" : "~allow_reset is false";
  if (problem.empty()) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      waiting_.reset();
    }
    problem = onWorker([this] { resetGraph(); });
  }
  if (problem.empty()) problem = askMapping<std_srvs::Trigger>("reset", request);
  response.success = problem.empty();
  response.message = problem.empty() ? "the graph is empty" : problem;
  return true;
}

}  // namespace occusg_ros
