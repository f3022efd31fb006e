#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds OccuSG and finds the rooms in the recording that comes with it.
# Usage: scripts/demo.sh [--no-install]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

install=yes
for argument in "$@"; do
  case $argument in
    --no-install) install=no ;;
    -h | --help) echo "usage: scripts/demo.sh [--no-install]"; exit 0 ;;
    *) echo "demo.sh: '$argument' is none of its options; usage: scripts/demo.sh [--no-install]" >&2; exit 2 ;;
  esac
done

if [ $install = yes ]; then
  echo "== Packages"
  "$root/scripts/install_dependencies.sh" --for demo
fi

echo "== Build of the library and the command (log: build/demo.log)"
build=$root/build/release
mkdir -p "$build"
# A folder that is configured keeps its options, so that the demo leaves out nothing that was built before.
options=(-DOCCUSG_UNITY_BUILD=ON -DOCCUSG_BUILD_ROS=OFF -DOCCUSG_BUILD_TESTS=OFF -DOCCUSG_BUILD_BENCHMARKS=OFF)
if [ -e "$build/CMakeCache.txt" ]; then options=(); fi
# shellcheck source=scripts/environment.sh
. "$root/scripts/environment.sh"
build_command() {
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release "${options[@]}" &&
    cmake --build "$build" --target occusg
}
# Shows ninja's counter, the rest goes to the log.
if ! build_command 2>&1 | tee "$root/build/demo.log" |
  awk '/^\[[0-9]+\/[0-9]+\]/ { printf "\r  %s", $1; fflush() } END { print "" }'; then
  tail -n 40 "$root/build/demo.log" >&2
  echo "demo.sh: the build failed, see build/demo.log" >&2
  exit 1
fi

echo "== Run"
"$build/bin/occusg" run "$root/examples/apartment" -o "$root/out/demo"
echo
echo "The picture:     $root/out/demo/overview.png"
echo "The scene graph: $root/out/demo/scene_graph.json"
