// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <exception>
#include <filesystem>
#include <memory>
#include <ostream>
#include <utility>

#include "mapping_node.hpp"
#include "occusg/error.hpp"
#include "occusg/io/map_files.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/output_folder.hpp"
#include "occusg/io/session_folder.hpp"
#include "occusg_ros/chunked_buffer.hpp"
#include "occusg_ros/saved_folder.hpp"

namespace occusg_ros {
namespace {

constexpr const char* kMapFile = "map.ot";

/// The storeys of the session beside a map; none where there is no session. The session is checked
/// whole: the other node refuses one that cannot be used, and so must this one.
occusg::Building buildingIn(const std::string& folder, const occusg::OccupancyMapConfig& config) {
  const std::string session = sessionIn(folder);
  if (!std::filesystem::exists(session)) return {};
  return occusg::loadSession(session, config).state.building;
}

}  // namespace

std::unique_ptr<occusg::MapPipeline> MappingNode::emptyMap() const {
  return std::make_unique<occusg::MapPipeline>(config_, storeysIn(settings_));
}

void MappingNode::resetMap() {
  map_ = emptyMap();
  showNewMap();
}

// Whoever shows the layer must see that it is another one.
void MappingNode::showNewMap() {
  pose_gate_.reset();
  last_layer_s_.reset();
  unpublished_.reset();
  noteStatus(0.0);
  std_msgs::Header header;
  header.stamp = ros::Time::now();
  header.frame_id = settings_.map_frame;
  storeys_.forget(*map_, header);
  sendLayer(header);
}

std::string MappingNode::folderOf(const std::string& name) const {
  return expandedFolder(settings_.saving.save_folder, handles_.inputs.getNamespace()) + "/" +
         checkedSaveName(name);
}

Saver::Writing MappingNode::writingTo(const std::string& name, Saver::When when) const {
  // A copy of the bytes: the tree itself goes on changing.
  const auto tree = std::make_shared<ChunkedBuffer>();
  std::ostream stream(tree.get());
  occusg::writeOctomap(map_->occupancyMap().tree(), occusg::OctomapEncoding::kFull, stream);
  return [this, name, when, tree = std::shared_ptr<const ChunkedBuffer>(tree),
          layer = occusg::toMapFiles(map_->freeSpace(), "free_space.pgm")] {
    if (saver_.mayLeaveOff(when)) return;
    if (name == kDefaultSaveName) generations_.makeRoom();
    const occusg::OutputFolder files(folderOf(name));
    (void)files.write(kMapFile, [&tree](std::ostream& out) { tree->writeTo(out); });
    files.write("free_space.pgm", layer.pgm);
    files.write("free_space.yaml", layer.yaml);
  };
}

std::string MappingNode::save(const std::string& name) {
  std::string folder = folderOf(name);
  saver_.write(writingTo(name, Saver::When::kNow));
  return folder;
}

void MappingNode::saveFromTimeToTime() {
  const double now_s = steadySeconds();
  const std::size_t frames = map_->counts().frames;
  if (frames == frames_saved_ || !saver_.isDue(now_s)) return;
  frames_saved_ = frames;
  saver_.writeInBackground(now_s, writingTo(kDefaultSaveName, Saver::When::kInBackground));
}

void MappingNode::saveAtEnd() {
  if (!settings_.saving.save_on_exit || map_->counts().frames == 0) return;
  saver_.saveAtEnd(handles_.name, [this] { return save(kDefaultSaveName); });
}

void MappingNode::noteSave(const std::string& folder, const std::string& problem) {
  if (!problem.empty()) ROS_WARN_STREAM(handles_.name << ": the map is not saved: " << problem);
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.saves.note(folder, problem, steadySeconds());
}

void MappingNode::load(const std::string& name) {
  // Into a fresh one: a file that cannot be used leaves the live map as it is.
  std::unique_ptr<occusg::MapPipeline> loaded = emptyMap();
  const occusg::Building building = buildingIn(folderOf(name), config_.occupancy);
  loaded->startFrom(occusg::readOctomap(mapFileIn(folderOf(name)), config_.occupancy), building);
  if (!settings_.find_storeys && building.storeys.size() > 1) {
    ROS_WARN_STREAM(handles_.name << ": " << name << " has " << building.storeys.size()
                                  << " storeys; ~find_storeys is false, so they become one");
  }
  const occusg::FarIslands& cut = loaded->occupancyMap().cutIslands();
  if (!cut.none()) ROS_WARN_STREAM(handles_.name << ": " << name << ": " << sentenceOn(cut));
  map_ = std::move(loaded);
  showNewMap();
}

void MappingNode::resume() {
  const std::string name = generations_.hasCrashed() ? kDefaultSaveName : settings_.saving.resume;
  if (name.empty()) return;
  if (generations_.hasCrashed() && !std::filesystem::exists(folderOf(name)))
    return;  // killed before it saved
  const std::string folder = folderOf(name);
  try {
    load(name);
    ROS_INFO_STREAM(handles_.name << ": continues from the map " << folder);
  } catch (const std::exception& error) {
    const std::string aside = generations_.setAside(name);
    ROS_WARN_STREAM(handles_.name << ": begins with an empty map: " << error.what()
                                  << (aside.empty() ? "" : "; it is kept as " + aside));
  }
}

bool MappingNode::onReset(std_srvs::Trigger::Request& /*request*/,
                          std_srvs::Trigger::Response& response) {
  if (!settings_.saving.allow_reset) {
    response.success = false;
    response.message = "~allow_reset is false";
    return true;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.clear();
  }
  response.success = worker_->run([this] { resetMap(); }, kServicePatience);
  response.message = response.success ? "the map is empty" : "the map did not answer in time";
  return true;
}

bool MappingNode::onPause(std_srvs::SetBool::Request& request,
                          std_srvs::SetBool::Response& response) {
  paused_ = request.data;
  response.success = true;
  response.message = request.data ? "paused" : "running";
  return true;
}

bool MappingNode::onSave(occusg::SaveMap::Request& request, occusg::SaveMap::Response& response) {
  // Shared: the save may end after the patience has.
  struct Outcome {
    std::string folder;
    std::string problem;
  };
  const auto outcome = std::make_shared<Outcome>();
  const bool done = worker_->run(
      [this, name = request.name, outcome] {
        try {
          checkQuota(expandedFolder(settings_.saving.save_folder, handles_.inputs.getNamespace()),
                     checkedSaveName(name), settings_.saving.save_quota);
          outcome->folder = save(name);
        } catch (const std::exception& error) {
          outcome->problem = error.what();
        }
      },
      kServicePatience);
  const std::string problem = done ? outcome->problem : "the map did not answer in time";
  response.success = problem.empty();
  response.message = problem.empty() ? "saved" : problem;
  if (problem.empty()) response.folder = outcome->folder;
  noteSave(response.folder, problem);
  return true;
}

bool MappingNode::onLoad(occusg::LoadMap::Request& request, occusg::LoadMap::Response& response) {
  const auto problem = std::make_shared<std::string>();
  const bool done = worker_->run(
      [this, name = request.name, problem] {
        try {
          load(name);
        } catch (const std::exception& error) {
          *problem = error.what();
        }
      },
      kServicePatience);
  response.success = done && problem->empty();
  response.message = !done ? "the map did not answer in time" : *problem;
  return true;
}

}  // namespace occusg_ros
