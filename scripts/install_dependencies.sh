#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the Debian or Ubuntu packages OccuSG needs, after saying which and why.
# Usage: scripts/install_dependencies.sh [--for-development]
set -euo pipefail

# package | what it is for
packages="
cmake               | configures the build
ninja-build         | runs the build
g++                 | compiles C++17
libboost-dev        | needed by CGAL
libboost-program-options-dev | the command line
libcgal-dev         | exact geometry of the decomposition
libeigen3-dev       | poses
libgtest-dev        | the tests
liboctomap-dev      | the 3D occupancy map
libopencv-dev       | images in, pictures out
libpcl-dev          | clusters of object points
libpolyclipping-dev | areas polygons share
libyaml-cpp-dev     | configuration files
nlohmann-json3-dev  | rooms.json, scene_graph.json
python3             | tables of results
python3-jsonschema  | checks scene_graph.json against its schema
python3-networkx    | reads scene_graph.graphml in a test
"
# ROS 1 from Debian; on Ubuntu 20.04 it comes with Noetic in /opt/ros.
if [ ! -d /opt/ros/noetic ]; then
  packages+="catkin              | makes the build a ROS 1 package
ros-message-generation | messages and services
ros-message-runtime | the same, when running
ros-geometry-msgs   | definitions our messages use
ros-nav-msgs        | definitions our messages use
ros-sensor-msgs     | definitions our messages use
ros-std-msgs        | definitions our messages use
libdiagnostic-updater-dev | diagnostics of the nodes
libdynamic-reconfigure-config-init-mutex-dev | parameters that change live
libimage-transport-dev | images in
libmessage-filters-dev | colour and depth that belong together
libnodeletlib-dev   | nodelets
libnodeletlib-tools | their manager
librosbag-dev       | bags in and out
libroscpp-dev       | the nodes
libstd-srvs-dev     | services: reset, pause
libtf2-ros-dev      | poses
libvisualization-msgs-dev | markers for rviz
pluginlib-dev       | nodelets
python3-diagnostic-msgs | the tests read diagnostics
python3-dynamic-reconfigure | parameters that change live
python3-nav-msgs    | the tests send maps
python3-nodelet     | the tests unload and load nodelets
python3-numpy       | the tests make images
python3-rosbag      | rosbag play
python3-roslaunch   | roslaunch
python3-rosmsg      | rosmsg show
python3-rosnode     | rosnode list
python3-rosparam    | rosparam
python3-rospy       | the tests of the nodes
python3-rosservice  | rosservice call
python3-rostest     | the tests of the nodes
librostest-dev      | the tests of the nodes
python3-rostopic    | rostopic echo
python3-std-srvs    | the tests call services
python3-tf2-msgs    | the tests send poses
python3-visualization-msgs | the tests read markers
rosbash             | rosrun
rosout              | roscore
rviz                | the picture while it runs
imagemagick         | screenshots of rviz
libgl1-mesa-dri     | rviz without a graphics card
xauth               | rviz without a screen
xvfb                | rviz without a screen
"
fi
if [ "${1:-}" = "--for-development" ]; then
  packages+="catkin-lint         | checks the ROS package
clang-format        | checks the layout of the code
clang-tidy          | checks the code
gcovr               | measures what the tests cover
libbenchmark-dev    | the benchmarks
python3-venv        | a Python environment for spark-dsg, which opens scene_graph.dsg.json
"
elif [ $# -gt 0 ]; then
  echo "usage: scripts/install_dependencies.sh [--for-development]" >&2
  exit 2
fi

installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

missing=()
while IFS='|' read -r package reason; do
  package=${package// /}
  [ -n "$package" ] || continue
  if ! installed "$package"; then
    [ ${#missing[@]} -gt 0 ] || echo "These packages will be installed with apt-get:"
    printf '  %-29s for%s\n' "$package" ":$reason"
    missing+=("$package")
  fi
done <<< "$packages"

if [ ${#missing[@]} -eq 0 ]; then
  echo "All needed packages are installed."
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo > /dev/null; then
    echo "install_dependencies.sh: not root and no sudo; ask an administrator to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}" > /dev/null
echo "Installed ${#missing[@]} packages."
