#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Every launch file and every YAML file loads, with all its arguments, and every launch file for a robot or a recording
# passes on what it is given; needs no master.
# Usage: launch_files_test.sh ROOT
set -euo pipefail
root=$1
for launch in "$root"/launch/*.launch "$root"/launch/bringup/*.launch; do
  arguments=()
  # The drivers' packages are the user's.
  if grep -q 'arg name="driver"' "$launch"; then
    arguments+=(driver:=false)
  fi
  # What has no default must be given.
  for name in $(sed -n 's/.*<arg name="\([a-z_]*\)" doc=.*/\1/p' "$launch"); do arguments+=("$name:=given"); done
  echo "$launch"
  roslaunch --dump-params "$launch" "${arguments[@]}" > /dev/null
  # A pattern for two robots is not one for a robot.
  if [ "$(basename "$launch")" != several_robots.launch ]; then
    loaded=$(roslaunch --dump-params "$launch" "${arguments[@]}" resume:=tested save_folder:=tested autosave_period_s:=7.5 \
      pose_source:=odometry odom:=tested robot_frame:=tested)
    for parameter in resume save_folder autosave_period_s pose_source odom robot_frame; do
      if ! grep -qE "^/occusg/scene_graph/$parameter: '?(tested|7.5|odometry)" <<< "$loaded"; then
        echo "launch_files_test: $launch does not pass $parameter on" >&2
        exit 1
      fi
    done
  fi
  undocumented=$(grep -c '<arg .*default="[^"]*"/>' "$launch" || true)
  if [ "$undocumented" -ne 0 ]; then
    echo "launch_files_test: an argument of $launch has no doc" >&2
    exit 1
  fi
done
# holds COMMAND... TEXT: the command line of a node holds the text.
holds() {
  local text=${*: -1}
  local line
  line=$("${@:1:$#-1}")
  if ! grep -qF -- "$text" <<< "$line"; then
    echo "launch_files_test: '$text' is not in: $line" >&2
    exit 1
  fi
}
holds roslaunch --args /rviz "$root/launch/bringup/laser_map.launch" rviz:=true map:=/robot/map \
  "/occusg/free_space:=/robot/map"
holds roslaunch --args /rviz "$root/launch/bringup/any_camera.launch" rviz:=true rgb_image:=/front/color \
  depth_image:=/front/depth depth_info:=/front/info "/camera/rgb/image_rect_color:=/front/color"
holds roslaunch --args /player "$root/launch/replay.launch" "sequence:=/data/my recording" "/data/my recording"
holds roslaunch --args /bag_player "$root/launch/occusg.launch" "bag:=/data/my drive.bag" "/data/my drive.bag"
for config in $(grep -l '^regions:' "$root"/config/*.yaml); do
  echo "$config"
  roslaunch --dump-params "$root/launch/occusg.launch" "config:=$config" |
    grep '/occusg/scene_graph/regions/period_s' > /dev/null
done
