// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <memory>

#include "mapping_node.hpp"
#include "occusg/error.hpp"

namespace occusg_ros {
namespace {

constexpr std::chrono::milliseconds kPatience{30000};

}  // namespace

bool MappingNode::onReset(std_srvs::Trigger::Request& /*request*/,
                          std_srvs::Trigger::Response& response) {
  if (!settings_.allow_reset) {
    response.success = false;
    response.message = "~allow_reset is false";
    return true;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.clear();
  }
  response.success = worker_->run([this] { resetMap(); }, kPatience);
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
          outcome->folder = save(name);
        } catch (const occusg::Error& error) {
          outcome->problem = error.what();
        }
      },
      kPatience);
  const std::string problem = done ? outcome->problem : "the map did not answer in time";
  response.success = problem.empty();
  response.message = problem.empty() ? "saved" : problem;
  if (problem.empty()) response.folder = outcome->folder;
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.last_save = problem.empty() ? response.folder : "failed: " + problem;
  return true;
}

}  // namespace occusg_ros
