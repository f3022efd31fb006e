#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Saved 3D maps as a user meets them: 'occusg project' and 'occusg run --map'.
# Usage: project_test.sh OCCUSG RECORDING WORK_FOLDER
set -uo pipefail
occusg=$1
recording=$2
work=$3
. "$(dirname "${BASH_SOURCE[0]}")/expectations.sh"

# refused NAME ERROR_TEXT ARGUMENTS...: exit code 1, one sentence, nothing written.
refused() {
  local name=$1 text=$2
  shift 2
  expect "$name" 1 "$text" "$@" -o out
  [ "$(wc -l < err.txt)" -eq 1 ] || fail "$name: more than one sentence"
  [ ! -e out ] || { fail "$name: an output folder was made"; rm -rf out; }
}

short_recording short 12
expect "run" 0 "" run short -o first

# --- The layer of a saved map is the layer the run had
expect "project" 0 "" project first/map.ot -o projected
cmp -s projected/free_space.pgm first/free_space.pgm || fail "project: another layer than the run's"
cmp -s projected/free_space.yaml first/free_space.yaml || fail "project: another place than the run's"
[ -s projected/overview.png ] || fail "project: no overview"
[ "$(ls projected | wc -l)" -eq 3 ] || fail "project: files left over"
expect "segment of the projected map" 0 "" segment projected/free_space.yaml -o rooms

# --- A run goes on from a map: what was known is known again
short_recording later 24
{ head -n 1 "$recording/depth.txt"; sed -n '14,25p' "$recording/depth.txt"; } > later/depth.txt
expect "run from a map" 0 "" run later -o second --map first/map.ot
expect "run of all frames" 0 "" run "$(short_recording all 24 && echo all)" -o whole
cmp -s second/map.ot whole/map.ot || fail "run --map: the map differs from that of one run"
cmp -s second/free_space.pgm whole/free_space.pgm || fail "run --map: the layer differs"

# --- A map made from a point cloud: the walls of a room of 0.8 m x 0.8 m, no free voxel
/usr/bin/python3 "$(dirname "${BASH_SOURCE[0]}")/walls_only_map.py" walls_only.bt
expect "map without rays" 0 "has no free voxel" project walls_only.bt -o walls
grep -q "0.00 m2 free, 0.36 m2 obstacles" out.txt || fail "map without rays: the walls are not drawn"
refused "map without rays, strict" "--unknown-is-free" project walls_only.bt --strict
expect "unknown is free" 0 "" project walls_only.bt -o walls --unknown-is-free
grep -q "0.64 m2 free, 0.36 m2 obstacles" out.txt || fail "unknown is free: the room is not free"

expect "unknown is free in a map with rays" 0 "first/map.ot: has free voxels, so --unknown-is-free changes nothing" \
  project first/map.ot -o with_rays --unknown-is-free
cmp -s with_rays/free_space.pgm projected/free_space.pgm || fail "unknown is free in a map with rays: another layer"
nodes=$(sed -n 's/^size //p' first/map.ot | head -n 1)
sed 's/^size .*/size 5/' first/map.ot > declares_five.ot
expect "another number of nodes than declared" 0 "holds $nodes nodes, 5 are declared" project declares_five.ot -o five
grep -q "^  $nodes nodes" out.txt || fail "another number of nodes than declared: the declared one is reported"

# --- Maps that cannot be used
refused "no map" "does not exist" project nowhere.bt
refused "run from no map" "does not exist" run short --map nowhere.bt
printf '# Octomap OcTree binary file\nid OcTree\nsize 0\nres 0.05\ndata\n' > empty.bt
refused "map without voxels" "empty.bt: holds nothing between the heights" project empty.bt
expect "project without a map" 2 "MAP is missing" project -o out
head -c 5000 first/map.ot > cut.ot
refused "map cut short" "cut.ot: ends at byte 5000" project cut.ot
refused "run from a map cut short" "cut.ot: ends at byte 5000" run short --map cut.ot
(cat first/map.ot; echo) > long.ot
refused "map that goes on" "goes on for 1 bytes" project long.ot
sed 's/^res 0.05$/res 0.1/' first/map.ot > coarse.ot
refused "map of another resolution" "coarse.ot: has voxels of 0.1 m" run short --map coarse.ot
expect "project takes the map's resolution" 0 "" project coarse.ot -o coarse
grep -q "resolution: 0.1" coarse/free_space.yaml || fail "project: not the map's resolution"
sed 's/^size .*/size 99999999999/' first/map.ot > huge.ot
refused "map that declares too much" "99999999999 nodes" project huge.ot

finish
