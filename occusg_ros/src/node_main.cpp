// SPDX-License-Identifier: BSD-3-Clause
// A nodelet alone in a process of its own: `rosrun occusg mapping`.
#include <nodelet/loader.h>
#include <ros/ros.h>

#include <csignal>
#include <string>

namespace {

// As SIGINT, which roscpp handles by itself: leave, so that what was found is saved.
extern "C" void shutDown(int /*signal*/) { ros::requestShutdown(); }

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, OCCUSG_NODELET);
  std::signal(SIGTERM, shutDown);
  nodelet::Loader loader;
  const nodelet::V_string arguments(argv + 1, argv + argc);
  const bool loaded =
      loader.load(ros::this_node::getName(), std::string("occusg/") + OCCUSG_NODELET,
                  ros::names::getRemappings(), arguments);
  if (!loaded) return 1;
  ros::spin();
  return 0;
}
