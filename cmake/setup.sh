# SPDX-License-Identifier: BSD-3-Clause
# Brings this installation of OccuSG into a shell session. OCCUSG_PREFIX names its folder where the shell cannot tell.
if [ ! -e "${OCCUSG_PREFIX:-}/share/occusg/package.xml" ]; then
  echo "setup.sh: set OCCUSG_PREFIX to the folder this file is in, or source setup.bash" >&2
  return 1
fi
# Ubuntu's ROS has a set-up file of its own; Debian's needs none.
if [ -e "/opt/ros/${ROS_DISTRO:-noetic}/setup.sh" ]; then
  . "/opt/ros/${ROS_DISTRO:-noetic}/setup.sh"
fi
export ROS_MASTER_URI="${ROS_MASTER_URI:-http://localhost:11311}"
export CMAKE_PREFIX_PATH="$OCCUSG_PREFIX${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}"
export ROS_PACKAGE_PATH="$OCCUSG_PREFIX/share${ROS_PACKAGE_PATH:+:$ROS_PACKAGE_PATH}"
export LD_LIBRARY_PATH="$OCCUSG_PREFIX/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
export PATH="$OCCUSG_PREFIX/bin:$PATH"
export PYTHONPATH="$OCCUSG_PREFIX/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}"
export PKG_CONFIG_PATH="$OCCUSG_PREFIX/lib/pkgconfig${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}"
