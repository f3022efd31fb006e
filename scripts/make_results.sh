#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes docs/report/ and the tables of docs/results.md: all recordings that have annotated rooms, then all floor plans.
# What is finished in OUT is not run again. HYDRA holds the rooms Hydra found, <scene>.json; JOBS (2), PYTHON, FRAMES,
# SIZE and OCCUSG as in evaluate_plans.sh.
# Usage: scripts/make_results.sh RECORDINGS HYDRA TOOLS PLANS OUT
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ $# -ne 5 ]; then
  echo "usage: scripts/make_results.sh RECORDINGS HYDRA TOOLS PLANS OUT" >&2
  exit 2
fi
recordings=$1 hydra=$2 tools=$3 plans=$4 out=$5
occusg=${OCCUSG:-"$root/build/release/bin/occusg"}
annotated=()
for truth in "$recordings"/*/rooms.json; do annotated+=("$(dirname "$truth")"); done

# publish RESULTS NAME: the report and the tables of one batch into docs/.
publish() {
  mkdir -p "$root/docs/report"
  cp "$1/report.html" "$root/docs/report/$2.html"
  /usr/bin/python3 "$root/scripts/update_results.py" "$1/results.json" "$root/docs/results.md" "$2"
}

# A run that failed is a row; the tables are made all the same.
status=0
"$occusg" batch "${annotated[@]}" -o "$out/recordings" --jobs "${JOBS:-2}" --title "Rooms in recordings" \
  --config default --config paper --decomposer dude --external hydra="$hydra" || status=$?
publish "$out/recordings" recordings
"$root/scripts/evaluate_plans.sh" "$tools" "$plans" "$out/plans" --config default --config paper \
  --external hydra="$hydra" || status=$?
publish "$out/plans/results" plans
exit $status
