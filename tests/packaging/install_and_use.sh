#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs a build into an empty folder and builds another project against it.
# Usage: install_and_use.sh BUILD_FOLDER
set -euo pipefail
build=$1
# Outside the package: roslaunch would find the launch files installed inside it a second time.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

# DESTDIR, not --prefix: catkin writes its set-up files to the prefix given when configuring.
DESTDIR="$work/stage" cmake --install "$build" > /dev/null
prefix=$(sed -n 's/^CMAKE_INSTALL_PREFIX:PATH=//p' "$build/CMakeCache.txt")
# Built with ROS, the package leads to catkin, whose modules belong to the system's Python.
cmake -S "$here/consumer" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 \
  -Doccusg_DIR="$work/stage$prefix/share/occusg/cmake"
cmake --build "$work/build"
LD_LIBRARY_PATH="$work/stage$prefix/lib:${LD_LIBRARY_PATH:-}" "$work/build/consumer"
"$work/stage$prefix/bin/occusg" --version
