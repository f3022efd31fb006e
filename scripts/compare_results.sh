#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs two builds of the command on recordings, with both configurations, and compares what they write byte by byte:
# a change of the layout must not change a result.
# Usage: scripts/compare_results.sh OLD_OCCUSG NEW_OCCUSG RECORDING...
set -euo pipefail
if [ $# -lt 3 ]; then
  echo "usage: scripts/compare_results.sh OLD_OCCUSG NEW_OCCUSG RECORDING..." >&2
  exit 2
fi
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
old=$(realpath "$1")
new=$(realpath "$2")
shift 2
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
compared=0
differing=0
for recording in "$@"; do
  for configuration in default paper; do
    for side in old new; do
      "${!side}" run "$recording" -o "$work/$side" --config "$root/config/$configuration.yaml" > "$work/$side.log" 2>&1 ||
        { tail -n 5 "$work/$side.log" >&2; echo "compare_results.sh: ${!side} fails on $recording" >&2; exit 1; }
    done
    for file in rooms.json scene_graph.json map.ot free_space.pgm; do
      compared=$((compared + 1))
      cmp -s "$work/old/$file" "$work/new/$file" && continue
      differing=$((differing + 1))
      echo "$recording, $configuration: $file differs"
    done
    rm -rf --one-file-system "$work/old" "$work/new"
  done
done
echo "$compared files compared, $differing differ."
[ $differing = 0 ]
