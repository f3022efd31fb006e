#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Measures which lines of the core the tests reach; fails below 85 %.
# Usage: scripts/coverage.sh [--no-install]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build="$root/build/coverage"

if [ "${1:-}" != "--no-install" ]; then
  "$root/scripts/install_dependencies.sh" --for development --without-ros
fi
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS="--coverage -O1" \
  -DOCCUSG_BUILD_ROS=OFF -DOCCUSG_BUILD_BENCHMARKS=OFF
cmake --build "$build"
find "$build" -name '*.gcda' -delete
(cd "$build" && ctest -L core -j "$(nproc)" --output-on-failure)
gcovr --root "$root" "$build/occusg_core" "$build/tests" \
  --filter "$root/occusg_core/src/" --filter "$root/occusg_core/include/" \
  --exclude-throw-branches --print-summary --fail-under-line 85
