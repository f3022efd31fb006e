#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds OccuSG with catkin_make beside another package that uses it, and sees that launch files and
# nodelets are found from the devel space and from the install space.
# Usage: scripts/check_catkin_workspace.sh WORK_FOLDER [CMAKE_ARGUMENT...]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
work=$(realpath -m "${1:?name a folder to work in}")
shift

mkdir -p "$work/src/robot_rooms"
ln -sfn "$root" "$work/src/occusg"
cat > "$work/src/robot_rooms/package.xml" <<'XML'
<package format="3">
  <name>robot_rooms</name><version>0.0.1</version><description>Uses occusg.</description>
  <maintainer email="nobody@example.org">nobody</maintainer><license>BSD</license>
  <buildtool_depend>catkin</buildtool_depend><depend>occusg</depend><depend>roscpp</depend>
</package>
XML
cat > "$work/src/robot_rooms/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.16)
project(robot_rooms)
set(CMAKE_CXX_STANDARD 17)
find_package(catkin REQUIRED COMPONENTS occusg roscpp)
catkin_package()
add_executable(robot_rooms main.cpp)
add_dependencies(robot_rooms ${catkin_EXPORTED_TARGETS})
target_include_directories(robot_rooms PRIVATE ${catkin_INCLUDE_DIRS})
target_link_libraries(robot_rooms ${catkin_LIBRARIES})
install(TARGETS robot_rooms DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
CMAKE
cat > "$work/src/robot_rooms/main.cpp" <<'CPP'
#include <occusg/RoomInfo.h>
#include <occusg/geometry/polygon.hpp>
int main() { return occusg::RoomInfo().id == 0 && occusg::area(occusg::Polygon{}) == 0.0 ? 0 : 1; }
CPP

cd "$work"
# The Python that has the ROS modules; another one may be first on PATH.
catkin_make install -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 \
  -DCMAKE_BUILD_TYPE=Release -DOCCUSG_BUILD_TESTS=OFF \
  -DOCCUSG_BUILD_BENCHMARKS=OFF "$@"

export ROS_MASTER_URI=http://127.0.0.1:11399 ROS_HOSTNAME=127.0.0.1
for space in devel install; do
  (
    set +u
    . "$work/$space/setup.bash"
    set -u
    package=$(rospack find occusg)
    echo "$space space: $package"
    for launch in "$package"/launch/*.launch "$package/launch/bringup/laser_map.launch"; do
      for node in $(roslaunch --nodes "$launch"); do echo "  $(basename "$launch"): $node"; done
    done
    rospack plugins --attrib=plugin nodelet | grep '^occusg '
    [ -s "$(rospack plugins --attrib=plugin nodelet | sed -n 's/^occusg //p')" ]
    rosmsg show occusg/RoomInfo > /dev/null
    rossrv show occusg/GetPath > /dev/null
    rosrun occusg occusg_bag --help > /dev/null
    [ -s "$package/config/default.yaml" ] && [ -s "$package/examples/apartment/depth.txt" ]
    rosrun robot_rooms robot_rooms
    roslaunch -p "${ROS_MASTER_URI##*:}" occusg demo.launch rviz:=false rate:=10 > "$work/$space.log" 2>&1 &
    timeout 60 bash -c 'until rostopic list > /dev/null 2>&1; do sleep 0.5; done; rostopic echo -n 1 /occusg/rooms/rooms[0]/name'
    kill -INT $! && wait $! || true
  )
done
echo "the catkin workspace works from both spaces."
