#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what the build needs and builds OccuSG in Release: the library, the command, the ROS nodes.
# Usage: scripts/build.sh [--no-install] [--without-ros] [--tests] [CMAKE_OPTION...]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build="$root/build/release"

usage="usage: scripts/build.sh [--no-install] [--without-ros] [--tests] [CMAKE_OPTION...]"
install=yes
with_ros=ON
with_tests=OFF
while [ $# -gt 0 ]; do
  case $1 in
    --no-install) install=no ;;
    --without-ros) with_ros=OFF ;;
    --tests) with_tests=ON ;;
    -h | --help) echo "$usage"; exit 0 ;;
    *) break ;;
  esac
  shift
done
for argument in "$@"; do
  case $argument in
    --*) echo "build.sh: '$argument' is none of its options, nor one of CMake's such as -DNAME=VALUE; $usage" >&2; exit 2 ;;
    -?*) ;;
    *) echo "build.sh: '$argument' is no option; $usage" >&2; exit 2 ;;
  esac
done

if [ $install = yes ]; then
  purpose=(--for ros)
  if [ $with_tests = ON ]; then purpose=(--for tests); fi
  if [ $with_ros = OFF ]; then purpose+=(--without-ros); fi
  "$root/scripts/install_dependencies.sh" "${purpose[@]}"
fi
# shellcheck source=scripts/environment.sh
. "$root/scripts/environment.sh"
mkdir -p "$build"
{
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DOCCUSG_UNITY_BUILD=ON -DOCCUSG_RELOCATABLE_INSTALL=ON \
    -DOCCUSG_BUILD_ROS=$with_ros -DOCCUSG_BUILD_TESTS=$with_tests -DCATKIN_DEVEL_PREFIX="$root/devel" "$@" &&
    cmake --build "$build"
} 2>&1 | tee "$root/build/build.log"
