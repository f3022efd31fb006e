#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds Release and runs benchmarks; the last line is one JSON object.
# Usage: scripts/bench.sh decomposition [MAPS]   MAPS: folder of 2D maps, left out when not given
#        scripts/bench.sh mapping [RECORDINGS]   RECORDINGS: folder of RGB-D sequences, likewise
#        scripts/bench.sh graph                  one update of scene graphs of 10 to 1000 rooms
#        scripts/bench.sh regions                one update of the regions in buildings of 100 to 10 000 m2
#        scripts/bench.sh saving                 a save of 10 000 m2, and a million agents in a session
#        scripts/bench.sh shutdown               SIGINT to exit with a map of 10 000 m2 and an autosave every second
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
what=${1:-}
if [[ ! "$what" =~ ^(decomposition|mapping|graph|regions|saving|shutdown)$ ]] || [ $# -gt 2 ] || [[ "$what" =~ ^(graph|regions|saving|shutdown)$ && $# -gt 1 ]]; then
  echo "usage: scripts/bench.sh decomposition [MAPS] | mapping [RECORDINGS] | graph | regions | saving | shutdown" >&2
  exit 2
fi
data=${2:+$(cd "$2" && pwd)}
variable=OCCUSG_MAPS2D_DIR
if [ "$what" = mapping ]; then variable=OCCUSG_RGBD_DIR; fi

ros=(--without-ros)
if [ "$what" = shutdown ]; then ros=(); fi
"$root/scripts/install_dependencies.sh" --for development "${ros[@]}" >&2
"$root/scripts/build.sh" --no-install "${ros[@]}" -DOCCUSG_BUILD_BENCHMARKS=ON -D$variable="$data" > "$root/build/bench.log" 2>&1 || {
  tail -n 40 "$root/build/bench.log" >&2
  exit 1
}

case $what in graph | regions) exec "$root/build/release/benchmarks/${what}_benchmark" ;; esac
if [[ "$what" =~ ^(saving|shutdown)$ ]]; then
  work=$(mktemp -d)
  trap 'rm -rf --one-file-system "$work"' EXIT
  saved=$("$root/build/release/benchmarks/saving_benchmark" "$work")
  echo "$saved"
  if [ "$what" = shutdown ]; then
    "$root/devel/env.sh" "$root/benchmarks/shutdown_time.py" "$work/map.ot" "$root/examples/apartment"
  fi
  exit
fi

run() {
  "$root/build/release/benchmarks/$1" --benchmark_out="$root/build/$1.json" \
    --benchmark_out_format=json "${@:2}"
}

if [ "$what" = mapping ]; then
  run mapping_benchmark
  run projection_benchmark
  /usr/bin/python3 "$root/scripts/mapping_ratios.py" "$root"/build/{mapping,projection}_benchmark.json
  exit
fi

run decomposition_benchmark --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
/usr/bin/python3 - "$root/build/decomposition_benchmark.json" << 'PYTHON'
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    rows = json.load(file)["benchmarks"]
to_ms = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
medians = {row["run_name"] + "_ms": round(row["cpu_time"] * to_ms[row["time_unit"]], 4)
           for row in rows if row.get("aggregate_name") == "median"}
growth = {row["run_name"] + "_growth_kib": row["growth_kib"] for row in rows if "growth_kib" in row}
print(json.dumps({**medians, **growth}))
PYTHON
