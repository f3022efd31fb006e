// SPDX-License-Identifier: BSD-3-Clause
#include <ros/console.h>
#include <ros/service.h>
#include <ros/time.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/output_folder.hpp"
#include "occusg/io/results.hpp"
#include "occusg/io/session_folder.hpp"
#include "occusg/io/session_repair.hpp"
#include "occusg_ros/saved_folder.hpp"
#include "scene_graph_node.hpp"

namespace occusg_ros {
namespace {

// The node that maps writes these beside.
bool isOfTheLayer(const std::string& name) {
  return name == "free_space.pgm" || name == "free_space.yaml";
}

bool isBelow(const occusg::StoreyLayer& a, const occusg::StoreyLayer& b) {
  return a.storey.floor_z_m < b.storey.floor_z_m;
}

/// By the wall clock: simulated time begins anew, and its sessions are no less credible.
void repair(occusg::SessionState& state, const std::string& folder) {
  constexpr double kTolerance_s = 5.0;
  const std::size_t stamps =
      occusg::repairStamps(state, ros::WallTime::now().toSec() + kTolerance_s);
  if (stamps == 0) return;
  ROS_WARN_STREAM(folder << ": " << stamps
                         << " stamps of the session are from the future; taken as of the latest "
                            "stamp before");
}

}  // namespace

std::string SceneGraphNode::folderOf(const std::string& name) const {
  return expandedFolder(settings_.saving.save_folder, handles_.inputs.getNamespace()) + "/" +
         checkedSaveName(name);
}

occusg::FreeSpace SceneGraphNode::emptyLayer() const {
  occusg::FreeSpace layer;
  layer.frame.resolution_m = config_.occupancy.resolution_m;
  return layer;
}

void SceneGraphNode::forgetLayers() { layers_.assign(rooms_->storeyCount(), emptyLayer()); }

void SceneGraphNode::resetGraph() {
  rooms_ = std::make_unique<occusg::BuildingPipeline>(config_);
  given_storeys_ = GivenStoreys(config_.graph.rooms.floor_z_m);
  has_mapped_storeys_ = false;
  awaits_map_ = false;
  forgetLayers();
  last_maintenance_s_.reset();
  std_msgs::Header header;
  header.stamp = ros::Time::now();
  header.frame_id = settings_.map_frame;
  publish(header);
  noteStatus();
}

// The session is without a map: the 3D map is the other node's, which saves it beside, so that each
// of the two can save and load alone.
Saver::Writing SceneGraphNode::writingTo(const std::string& name, Saver::When when) const {
  auto state = std::make_shared<occusg::SessionState>();
  state->scene = settings_.scene;
  state->stamp_s = timeline_.last();
  state->T_map_agent = last_pose_;
  rooms_->saveTo(*state);
  const bool has_layer = settings_.mapping_node.empty();
  return [this, name, when, has_layer, state = std::shared_ptr<const occusg::SessionState>(state),
          layers = layers_, graph = rooms_->graph(), times = rooms_->times(),
          floor_z_m = config_.graph.rooms.floor_z_m] {
    if (name == kDefaultSaveName) generations_.makeRoom();
    const occusg::OutputFolder files(folderOf(name));
    occusg::saveSession(sessionIn(files.path()), *state);
    const occusg::Building& building = state->building;
    occusg::Findings findings{layers[building.current], graph, floor_z_m, state->scene};
    if (building.storeys.size() > 1) {
      for (std::size_t storey = 0; storey < building.storeys.size(); ++storey)
        findings.storeys.push_back({building.storeys[storey], &layers[storey]});
      std::sort(findings.storeys.begin(), findings.storeys.end(), isBelow);
    }
    for (const occusg::ResultWriter& file : occusg::resultWriters(findings, times)) {
      if (saver_.mayLeaveOff(when)) return;
      if (has_layer || !isOfTheLayer(file.name)) (void)files.write(file.name, file.write);
    }
  };
}

std::string SceneGraphNode::save(const std::string& name) {
  std::string folder = folderOf(name);
  saver_.write(writingTo(name, Saver::When::kNow));
  return folder;
}

void SceneGraphNode::saveFromTimeToTime() {
  const double now_s = steadySeconds();
  if (!rooms_->lastUpdate() || sequence_ == sequence_saved_ || !saver_.isDue(now_s)) return;
  sequence_saved_ = sequence_;
  saver_.writeInBackground(now_s, writingTo(kDefaultSaveName, Saver::When::kInBackground));
}

void SceneGraphNode::saveAtEnd() {
  if (!settings_.saving.save_on_exit || !rooms_->lastUpdate()) return;
  saver_.saveAtEnd(handles_.name, [this] { return save(kDefaultSaveName); });
}

void SceneGraphNode::noteSave(const std::string& folder, const std::string& problem) {
  if (!problem.empty()) ROS_WARN_STREAM(handles_.name << ": the rooms are not saved: " << problem);
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.saves.note(folder, problem, steadySeconds());
}

void SceneGraphNode::load(const std::string& name) {
  const std::string folder = folderOf(name);
  occusg::Session session = occusg::loadSession(sessionIn(folder), config_.occupancy);
  repair(session.state, folder);
  // The node that maps loads it after this: a map that cannot be used leaves the rooms as they are
  // too.
  if (!settings_.mapping_node.empty())
    (void)occusg::readOctomap(mapFileIn(folder), config_.occupancy);
  // Into a fresh one: a session that cannot be used leaves the live graph as it is.
  auto loaded = std::make_unique<occusg::BuildingPipeline>(config_);
  loaded->resumeFrom(session.state);
  rooms_ = std::move(loaded);
  has_mapped_storeys_ = !settings_.mapping_node.empty() && rooms_->storeyCount() > 1;
  awaits_map_ = false;
  if (settings_.mapping_node.empty()) given_storeys_.resumeFrom(rooms_->building());
  last_pose_ = session.state.T_map_agent;
  last_maintenance_s_.reset();
  timeline_.goOnAfter(session.state.stamp_s, ros::Time::now().toSec());
  // Without a node that maps, what is there is the map of the session too.
  const bool has_the_map = settings_.mapping_node.empty() && rooms_->storeyCount() == 1 &&
                           layers_.size() == 1 && !layers_.front().cells.empty();
  if (has_the_map) {
    layers_.front().changed = layers_.front().cells.box();
    rooms_->update(0, viewOf(layers_.front()), last_pose_, timeline_.last());
  } else {
    forgetLayers();
  }
  std_msgs::Header header;
  header.stamp = ros::Time::now();
  header.frame_id = settings_.map_frame;
  publish(header);
}

void SceneGraphNode::resume() {
  const std::string name = generations_.hasCrashed() ? kDefaultSaveName : settings_.saving.resume;
  if (name.empty()) return;
  if (generations_.hasCrashed() && !std::filesystem::exists(folderOf(name)))
    return;  // killed before it saved
  try {
    load(name);
    ROS_INFO_STREAM(handles_.name << ": continues from the session " << folderOf(name) << " with "
                                  << lastGraph()->rooms.size() << " rooms");
  } catch (const std::exception& error) {
    const std::string aside = generations_.setAside(name);
    ROS_WARN_STREAM(handles_.name << ": begins without rooms: " << error.what()
                                  << (aside.empty() ? "" : "; it is kept as " + aside));
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
  std::string problem = onWorker([this, name = request.name, folder] {
    checkQuota(expandedFolder(settings_.saving.save_folder, handles_.inputs.getNamespace()),
               checkedSaveName(name), settings_.saving.save_quota);
    *folder = save(name);
  });
  if (problem.empty()) problem = askMapping<occusg::SaveMap>("save", request);
  response.success = problem.empty();
  response.message = problem.empty() ? "saved" : problem;
  response.folder = *folder;
  noteSave(response.folder, problem);
  return true;
}

bool SceneGraphNode::onLoad(occusg::LoadMap::Request& request,
                            occusg::LoadMap::Response& response) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.clear();
    waiting_storeys_.clear();
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
  std::string problem = settings_.saving.allow_reset ? "" : "~allow_reset is false";
  if (problem.empty()) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      waiting_.clear();
      waiting_storeys_.clear();
    }
    problem = onWorker([this] { resetGraph(); });
  }
  if (problem.empty()) problem = askMapping<std_srvs::Trigger>("reset", request);
  response.success = problem.empty();
  response.message = problem.empty() ? "the graph is empty" : problem;
  return true;
}

}  // namespace occusg_ros
