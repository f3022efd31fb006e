#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Cuts every laser map in a folder into rooms and prints mean F1 by group: the part of the name before the first '_', and,
# for simulated maps, their severity (the end of the name). MAPS holds NAME.yaml, its picture and NAME_gt_labels.png (16-bit
# room ids, pixels as the map's).
# Usage: scripts/evaluate_laser_maps.sh MAPS OUT [options of 'occusg segment']
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
occusg=${OCCUSG:-$root/build/release/bin/occusg}
if [ $# -lt 2 ]; then
  echo "usage: scripts/evaluate_laser_maps.sh MAPS OUT [options of 'occusg segment']" >&2
  exit 2
fi
maps=$1
out=$2
shift 2
for map in "$maps"/*.yaml; do
  name=$(basename "$map" .yaml)
  mkdir -p "$out/$name"
  "$occusg" segment "$map" -o "$out/$name" "$@" > "$out/$name/segment.log" 2>&1
  "$occusg" eval "$out/$name/labels.png" "$maps/${name}_gt_labels.png" --json "$out/$name/metrics.json" \
    --resolution "$(awk '/^resolution:/ {print $2}' "$map")" > "$out/$name/eval.log"
done
/usr/bin/python3 - "$out" << 'PYTHON'
import collections
import json
import pathlib
import re
import sys

groups = collections.defaultdict(list)
for path in sorted(pathlib.Path(sys.argv[1]).glob("*/metrics.json")):
    name = path.parent.name
    metrics = json.loads(path.read_text())
    scores = [metrics[key]["F1"] for key in ("@0.15", "@0.50", "@0.75")]
    print("%-24s" % name, " ".join("%.3f" % score for score in scores))
    group = name.split("_")[0]
    groups[group].append(scores)
    severity = re.search(r"_(s\d)$", name)
    if severity:
        groups[group + " " + severity.group(1)].append(scores)
print("\n%-10s %4s  F1@.15 F1@.50 F1@.75" % ("group", "maps"))
for group, scores in sorted(groups.items()):
    print("%-10s %4d" % (group, len(scores)), *(" %.3f" % (sum(column) / len(column)) for column in zip(*scores)))
PYTHON
