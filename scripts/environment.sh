# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the other scripts: brings the distribution's ROS into the environment where it has a set-up file.
# Debian's own ROS packages need none; Ubuntu's are in /opt/ros.
if [ -n "${ROS_DISTRO:-}" ] && [ -e "/opt/ros/$ROS_DISTRO/setup.bash" ]; then
  occusg_ros_setup=/opt/ros/$ROS_DISTRO/setup.bash
else
  occusg_ros_setup=$(ls /opt/ros/*/setup.bash 2> /dev/null | head -n 1) || true
fi
if [ -n "$occusg_ros_setup" ]; then
  # Set-up files read variables that are not set.
  set +u
  # shellcheck disable=SC1090
  . "$occusg_ros_setup"
  set -u
fi
