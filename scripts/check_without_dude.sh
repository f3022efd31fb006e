#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the library and the command without the decomposer dude and shows that nothing of CGAL that is under the GPL is in
# them: no header of such a package was read. Then finds the rooms of the recording in examples/.
# Usage: scripts/check_without_dude.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=build/without_dude
cmake -S . -B $build ${CMAKE_CXX_COMPILER_LAUNCHER:+-DCMAKE_CXX_COMPILER_LAUNCHER=$CMAKE_CXX_COMPILER_LAUNCHER} -G Ninja -DCMAKE_BUILD_TYPE=Release -DOCCUSG_WITH_DUDE=OFF -DOCCUSG_BUILD_ROS=OFF \
  -DOCCUSG_BUILD_TESTS=OFF -DOCCUSG_BUILD_BENCHMARKS=OFF -DOCCUSG_UNITY_BUILD=ON > /dev/null
cmake --build $build
headers=$(ninja -C $build -t deps | grep -oE '/[^ ]*/CGAL/[^ ]*' | sort -u)
if [ -z "$headers" ]; then
  echo "check_without_dude.sh: the build's list of headers is empty" >&2
  exit 1
fi
# shellcheck disable=SC2086
if gpl=$(grep -lE 'SPDX-License-Identifier: GPL' $headers); then
  printf 'check_without_dude.sh: headers under the GPL are in the build:\n%s\n' "$gpl" >&2
  exit 1
fi
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
$build/bin/occusg run examples/apartment -o "$work/out" > /dev/null
if [ "$(grep -c '"polygon"' "$work/out/rooms.json")" -eq 0 ]; then
  echo "check_without_dude.sh: no rooms were found" >&2
  exit 1
fi
if $build/bin/occusg run examples/apartment -o "$work/dude" --decomposer dude 2> "$work/sentence"; then
  echo "check_without_dude.sh: dude is in the build" >&2
  exit 1
fi
grep -F 'OCCUSG_WITH_DUDE=OFF' "$work/sentence"
echo "$(printf '%s\n' "$headers" | wc -l) headers of CGAL were read, none of them under the GPL; rooms were found."
