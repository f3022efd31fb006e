#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs a build, moves it, and uses it from another project: with CMake, without ROS, with pkg-config, and with ROS
# through its set-up file where it was built with ROS.
# Usage: install_and_use.sh BUILD_FOLDER
set -euo pipefail
build=$1
# Outside the package: roslaunch would find the launch files installed inside it a second time.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

cmake --install "$build" --prefix "$work/first" > /dev/null
mv "$work/first" "$work/moved"
prefix=$work/moved
! grep -rIl "$work/first" "$prefix" || { echo "these files name the prefix"; exit 1; }

echo "== CMake, the core alone: no package of ROS may be asked for"
cmake -S "$here/consumer" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -Doccusg_ROOT="$prefix" \
  -Doccusg_DIR="$prefix/share/occusg/cmake" -DCMAKE_DISABLE_FIND_PACKAGE_catkin=ON \
  -DCMAKE_DISABLE_FIND_PACKAGE_roscpp=ON
cmake --build "$work/build"
env -i "$work/build/consumer"
"$prefix/bin/occusg" --version

echo "== pkg-config"
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
# shellcheck disable=SC2046
g++ -std=c++17 "$here/consumer/main.cpp" -o "$work/by_pkg_config" $(pkg-config --cflags --libs occusg) \
  -Wl,-rpath,"$prefix/lib"
"$work/by_pkg_config"

[ -e "$prefix/setup.bash" ] || exit 0
echo "== ROS, by the set-up file"
env -i PATH=/usr/bin:/bin HOME="$work" bash -euc '
  . "$1/setup.bash"
  [ "$(rospack find occusg)" = "$1/share/occusg" ]
  rosmsg show occusg/RoomInfo > /dev/null
  rosrun occusg occusg_bag --help > /dev/null
  [ -s "$(rospack plugins --attrib=plugin nodelet | sed -n "s/^occusg //p")" ]
  roslaunch --nodes occusg demo.launch
  occusg --version' setup "$prefix"
