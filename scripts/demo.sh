#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds OccuSG and finds the rooms in the recording that comes with it.
# Usage: scripts/demo.sh [--no-install]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

install=yes
for argument in "$@"; do
  case $argument in
    --no-install) install=no ;;
    *) echo "usage: scripts/demo.sh [--no-install]" >&2; exit 2 ;;
  esac
done

if [ $install = yes ]; then
  echo "== Packages"
  "$root/scripts/install_dependencies.sh"
fi

echo "== Build (log: build/demo.log)"
mkdir -p "$root/build"
if ! "$root/scripts/build.sh" > "$root/build/demo.log" 2>&1; then
  tail -n 40 "$root/build/demo.log" >&2
  echo "demo.sh: the build failed, see build/demo.log" >&2
  exit 1
fi

echo "== Run"
"$root/build/release/bin/occusg" run "$root/examples/apartment" -o "$root/out/demo"
echo
echo "The picture:     $root/out/demo/overview.png"
echo "The scene graph: $root/out/demo/scene_graph.json"
