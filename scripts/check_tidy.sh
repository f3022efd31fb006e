#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs clang-tidy over the sources, with ROS when scripts/build.sh has built it.
# Usage: scripts/check_tidy.sh
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
sources=('occusg_core/*.cpp')
with_ros=OFF
# The messages' headers must have been generated.
if [ -d devel/include/occusg ]; then
  sources+=('occusg_ros/*.cpp')
  with_ros=ON
fi
# shellcheck source=scripts/environment.sh
. scripts/environment.sh
# Configured apart and never built: files, not batches of them.
cmake -S . -B build/tidy -G Ninja -DCMAKE_BUILD_TYPE=Release -DOCCUSG_UNITY_BUILD=OFF -DOCCUSG_BUILD_ROS=$with_ros \
  -DOCCUSG_BUILD_TESTS=OFF -DOCCUSG_BUILD_BENCHMARKS=OFF -DCATKIN_DEVEL_PREFIX="$root/devel" > /dev/null
# clang-tidy counts the warnings it suppressed in other people's headers; that says nothing here.
git ls-files "${sources[@]}" |
  xargs -P "$(nproc)" -n 1 clang-tidy --quiet -p build/tidy 2> >(grep -v 'warnings\? generated' >&2)
echo "clang-tidy: no findings in $(git ls-files "${sources[@]}" | wc -l) files."
