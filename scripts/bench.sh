#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds Release and runs a benchmark; the last line is one JSON object of medians.
# Usage: scripts/bench.sh decomposition [MAPS]   MAPS: folder of 2D maps, left out when not given
#        scripts/bench.sh graph                  one update of scene graphs of 10 to 1000 rooms
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ "${1:-}" = graph ] && [ $# -eq 1 ]; then
  "$root/scripts/install_dependencies.sh" --for-development >&2
  mkdir -p "$root/build"
  "$root/scripts/build.sh" > "$root/build/bench.log" 2>&1 || {
    tail -n 40 "$root/build/bench.log" >&2
    exit 1
  }
  exec "$root/build/release/benchmarks/graph_benchmark"
fi
if [ "${1:-}" != decomposition ] || [ $# -gt 2 ]; then
  echo "usage: scripts/bench.sh decomposition [MAPS] | graph" >&2
  exit 2
fi
maps=${2:+$(cd "$2" && pwd)}

"$root/scripts/install_dependencies.sh" --for-development >&2
"$root/scripts/build.sh" -DOCCUSG_MAPS2D_DIR="$maps" > "$root/build/bench.log" 2>&1 || {
  tail -n 40 "$root/build/bench.log" >&2
  exit 1
}
result="$root/build/decomposition_benchmark.json"
"$root/build/release/benchmarks/decomposition_benchmark" --benchmark_repetitions=5 \
  --benchmark_report_aggregates_only=true --benchmark_out="$result" --benchmark_out_format=json
/usr/bin/python3 - "$result" << 'PYTHON'
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
