#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Renders every floor plan in a folder into a recording and runs 'occusg batch' over all of them.
# TOOLS holds plan_to_scene.py and render_rgbd.py, PLANS the plans (<name>.json). Recordings go to OUT/recordings and are
# not rendered again, results to OUT/results. PYTHON names an interpreter that has what TOOLS needs (numpy, scipy,
# shapely, mapbox_earcut, trimesh, embreex, opencv-python-headless); FRAMES and SIZE set the recordings, OCCUSG the
# binary, JOBS how many run at a time (2).
# Usage: scripts/evaluate_plans.sh TOOLS PLANS OUT [options of 'occusg batch']
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ $# -lt 3 ]; then
  echo "usage: scripts/evaluate_plans.sh TOOLS PLANS OUT [options of 'occusg batch']" >&2
  exit 2
fi
export tools=$1 plans=$2 out=$3
shift 3
occusg=${OCCUSG:-"$root/build/release/bin/occusg"}
jobs=${JOBS:-2}
export python=${PYTHON:-python3} frames=${FRAMES:-300} size=${SIZE:-320x240}

# render NAME: one plan into OUT/recordings/NAME, in place only when it is complete.
render() {
  local name=$1
  local recording=$out/recordings/$name work=$out/rendering/$name
  [ ! -e "$recording" ] || return 0
  rm -rf "$work"
  mkdir -p "$work"
  "$python" "$tools/plan_to_scene.py" build --plan "$plans/$name.json" --out "$work" > "$work/log.txt" 2>&1 &&
    "$python" "$tools/render_rgbd.py" --mesh "$work/scene.ply" --rooms "$work/rooms.json" --out "$work/recording" \
      --max-frames "$frames" --size "$size" >> "$work/log.txt" 2>&1 || {
    echo "evaluate_plans.sh: $name cannot be rendered, see $work/log.txt" >&2
    return 1
  }
  mv "$work/recording" "$recording"
  rm -rf "$work"
  echo "rendered $name" >&2
}
export -f render

mkdir -p "$out/recordings"
find "$plans" -maxdepth 1 -name '*.json' -printf '%f\n' | sort | sed 's/\.json$//' |
  xargs -P "$jobs" -I{} bash -c 'render {}'
"$occusg" batch "$out"/recordings/*/ -o "$out/results" --jobs "$jobs" --title "Rooms in rendered floor plans" "$@"
