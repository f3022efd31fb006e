#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Scene graphs as a user reads them: 'occusg show', and the published system's schema.
# Usage: graph_files_test.sh OCCUSG RECORDING SOURCE_FOLDER WORK_FOLDER
set -uo pipefail
occusg=$1
recording=$2
source=$3
work=$4
. "$(dirname "${BASH_SOURCE[0]}")/expectations.sh"
# answers NAME TEXT ARGUMENTS...: standard output holds TEXT.
answers() {
  local name=$1 text=$2
  shift 2
  expect "$name" 0 "" "$@"
  grep -qF -- "$text" out.txt || fail "$name: standard output lacks '$text'"
}

short_recording short 80
ln -s "$recording/labels" short/labels
cp "$recording"/{rgb.txt,rooms.json,objects.json} short
expect "run" 0 "" run short -o out --schema occusg-1.0
grep -q '"schema_version": "1.0"' out/scene_graph.occusg-1.0.json || fail "published schema"
expect "unknown schema" 2 "occusg-1.0" run short -o other --schema hydra

# --- show
answers "show" "rooms, " show out/scene_graph.json
grep -q "adjacent to" out.txt || fail "show prints no rooms"
grep -q "doors between" out.txt || fail "show prints no doors"
place=$(sed -n 's/.*"name":"room_1".*"position":\[\([-0-9.]*\),\([-0-9.]*\),.*/\1 \2/p' out/scene_graph.json)
answers "room at a point" "room_1" show out/scene_graph.json --query "room at $place"
answers "room at a point outside" "none" show out/scene_graph.json --query "room at 900 900"
answers "way" " m" show out/scene_graph.json --query "way $place to $place"
grep -q "^room_1 " out.txt || fail "way: the room it leads through is missing"
answers "way to nowhere" "none" show out/scene_graph.json --query "way $place to 900 900"
class=$(sed -n 's/.*"class":"\([^"]*\)".*"type":"OBJECT".*/\1/p' out/scene_graph.json | head -1)
answers "nearest object" "m away" show out/scene_graph.json --query "nearest $class at $place"
grep -q "^object [0-9]* $class at " out.txt || fail "nearest object: its class is missing"
answers "nearest object of a class nobody saw" "none" show out/scene_graph.json --query "nearest grand piano at $place"
answers "contents" "in room 1" show out/scene_graph.json --query "contents of room_1"
beside=$("$occusg" show out/scene_graph.json --query "adjacent to 1" | sed -n 's/^room_\([0-9]*\) .*/\1/p' | head -1)
answers "adjacent rooms" "room_1 " show out/scene_graph.json --query "adjacent to $beside"
grep -q "^door at .* m wide, between rooms " out.txt || fail "adjacent rooms: their door is missing"
expect "contents of a room there is not" 1 "has no room of id or number 77" show out/scene_graph.json --query "contents of 77"
expect "adjacent rooms of a label there is not" 1 "has no room 'wine cellar'; its rooms are 1, " \
  show out/scene_graph.json --query "adjacent to wine cellar"
for query in "way to the kitchen" "way 1 2 to 3" "nearest at 1 2" "contents of" "room at 1 2 3 4" ""; do
  expect "query '$query'" 2 "room at X Y" show out/scene_graph.json --query "$query"
done
expect "broken point" 2 "room at X Y" show out/scene_graph.json --query "room at 1"
expect "show without a file" 2 "FILE is missing" show
expect "show a missing file" 1 "does not exist" show nowhere.json
head -c 3000 out/scene_graph.json > cut.json
expect "show a file cut short" 1 "cut.json:" show cut.json
sed 's/"version": 1/"version": 9/' out/scene_graph.json > newer.json
expect "show a newer file" 1 "newer.json: has version 9" show newer.json
head -c 1000000 /dev/zero | tr '\0' '[' > nested.json
expect "show a million nested arrays" 1 "nested.json: is nested deeper" show nested.json
[ "$(wc -l < err.txt)" -eq 1 ] || fail "more than one sentence"

finish
