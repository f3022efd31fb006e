#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs every recording in a folder and prints the tables of docs/results.md.
# OCCUSG names another binary than the one in build/release.
# Usage: scripts/evaluate_recordings.sh RECORDINGS OUT [options of 'occusg run']
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
occusg=${OCCUSG:-"$root/build/release/bin/occusg"}
if [ $# -lt 2 ]; then
  echo "usage: scripts/evaluate_recordings.sh RECORDINGS OUT [options of 'occusg run']" >&2
  exit 2
fi
recordings=$1
out=$2
shift 2

for recording in "$recordings"/*/; do
  name=$(basename "$recording")
  [ -f "$recording/depth.txt" ] || continue
  echo "$name" >&2
  mkdir -p "$out/$name"
  "$occusg" run "$recording" -o "$out/$name" "$@" > "$out/$name.log"
  if [ -f "$recording/rooms.json" ]; then
    "$occusg" eval "$out/$name/rooms.json" "$recording/rooms.json" --json "$out/$name/metrics.json" \
      > "$out/$name.eval.log"
  fi
done
/usr/bin/python3 "$root/scripts/results_table.py" "$out"
