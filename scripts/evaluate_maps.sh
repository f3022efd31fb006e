#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Cuts every map in a folder into rooms, with and without furniture, and prints a table.
# MAPS holds <map>.png, <map>_furnitures.png and <map>_gt_labels.png (16-bit room ids), 0.05 m a pixel; free is what is
# brighter than 250 of 255.
# Usage: scripts/evaluate_maps.sh MAPS OUT [options of 'occusg segment']
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
occusg=${OCCUSG:-$root/build/release/bin/occusg}
if [ $# -lt 2 ]; then
  echo "usage: scripts/evaluate_maps.sh MAPS OUT [options of 'occusg segment']" >&2
  exit 2
fi
maps=$1
out=$2
shift 2
mkdir -p "$out/grey"

# evaluate PICTURE TRUTH FOLDER [options]
evaluate() {
  local picture=$1 truth=$2 folder=$3
  local grey
  grey=$out/grey/$(basename "$picture")
  shift 3
  [ -s "$grey" ] || /usr/bin/python3 "$root/scripts/grey_png.py" "$picture" "$grey"
  mkdir -p "$folder"
  "$occusg" segment "$grey" -o "$folder" --resolution 0.05 --free-thresh 0.0197 "$@" > "$folder/segment.log"
  "$occusg" eval "$folder/labels.png" "$truth" --resolution 0.05 --json "$folder/metrics.json" > "$folder/eval.log"
}

for truth in "$maps"/*_gt_labels.png; do
  name=$(basename "$truth" _gt_labels.png)
  echo "$name" >&2
  evaluate "$maps/$name.png" "$truth" "$out/$name/plain" "$@"
  evaluate "$maps/${name}_furnitures.png" "$truth" "$out/$name/furnished" "$@"
done
/usr/bin/python3 "$root/scripts/maps_table.py" "$out"
