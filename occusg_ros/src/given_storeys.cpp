// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/given_storeys.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "occusg/error.hpp"

namespace occusg_ros {
namespace {

constexpr int kMostStoreys = 200;
/// Two lifts whose ends are nearer than this are the same one.
constexpr double kSameLift_m = 2.0;

bool areNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a - b).norm() <= kSameLift_m;
}

}  // namespace

GivenStoreys::GivenStoreys(double floor_z_m) { building_.storeys.push_back({0, floor_z_m, {}}); }

void GivenStoreys::resumeFrom(const occusg::Building& building) {
  if (building.storeys.empty()) return;
  building_ = building;
  last_feet_.reset();
}

void GivenStoreys::enter(int floor_id, double floor_z_m) {
  const int count = static_cast<int>(building_.storeys.size());
  if (floor_id < 0 || floor_id > count || floor_id >= kMostStoreys) {
    throw occusg::refuse("floor_id", "is " + std::to_string(floor_id),
                         "0 to " + std::to_string(count - 1) +
                             " are known, and the next storey is " + std::to_string(count));
  }
  if (floor_id == count) {
    const bool is_apart =
        std::isfinite(floor_z_m) &&
        std::all_of(building_.storeys.begin(), building_.storeys.end(),
                    [floor_z_m](const occusg::Storey& storey) {
                      return std::abs(storey.floor_z_m - floor_z_m) >= occusg::kLeastFall_m;
                    });
    if (!is_apart) {
      throw occusg::refuse("floor_z", "is " + occusg::shortestText(floor_z_m) + " m",
                           "a height at least 0.8 m from the floors of the other storeys is "
                           "needed");
    }
    building_.storeys.push_back({floor_id, floor_z_m, {}});
    divideHeights(building_.storeys);
  }
  building_.current = static_cast<std::size_t>(floor_id);
}

double GivenStoreys::heightOnStorey(double z_m) const {
  const occusg::Storey& storey = building_.storeys[building_.current];
  return storey.span.holds(z_m) ? z_m : z_m + storey.floor_z_m;
}

occusg::Pose GivenStoreys::onStorey(occusg::Pose T_map_robot) const {
  T_map_robot.translation().z() = heightOnStorey(T_map_robot.translation().z());
  return T_map_robot;
}

void GivenStoreys::observe(const occusg::Pose& T_map_robot) {
  const occusg::Storey& storey = building_.storeys[building_.current];
  Eigen::Vector3d feet = T_map_robot.translation();
  feet.z() = storey.floor_z_m;
  if (last_feet_ && last_storey_ != storey.id) addLift(*last_feet_, feet, last_storey_);
  last_feet_ = feet;
  last_storey_ = storey.id;
}

void GivenStoreys::addLift(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                           int from_storey) {
  occusg::StoreyPassage lift;
  lift.kind = occusg::StairsKind::kLift;
  lift.lower_storey = from_storey;
  lift.upper_storey = building_.storeys[building_.current].id;
  lift.path = {from, to};
  if (to.z() < from.z()) {
    std::swap(lift.lower_storey, lift.upper_storey);
    std::swap(lift.path.front(), lift.path.back());
  }
  const bool is_known = std::any_of(building_.passages.begin(), building_.passages.end(),
                                    [&lift](const occusg::StoreyPassage& known) {
                                      return known.lower_storey == lift.lower_storey &&
                                             known.upper_storey == lift.upper_storey &&
                                             areNear(known.path.front(), lift.path.front()) &&
                                             areNear(known.path.back(), lift.path.back());
                                    });
  if (!is_known) building_.passages.push_back(std::move(lift));
}

}  // namespace occusg_ros
