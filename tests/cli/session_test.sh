#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Sessions as a user meets them: 'occusg run --save-session' and '--resume'.
# Usage: session_test.sh OCCUSG RECORDING WORK_FOLDER
set -uo pipefail
occusg=$1
recording=$2
work=$3
. "$(dirname "${BASH_SOURCE[0]}")/expectations.sh"

# rooms FOLDER: id and name of each room.
rooms() { "$occusg" show "$1/scene_graph.json" | awk '/^  room /,/doors between/' | awk '$1 ~ /^[0-9]+$/ {print $1, $4}'; }

# count TYPE FOLDER: the nodes of a type. places TYPE FOLDER: where they stand, if on the same spot.
count() { grep -c "\"type\":\"$1\"" "$2/scene_graph.json"; }
doubled() { grep "\"type\":\"$1\"" "$2/scene_graph.json" | grep -o '"position":[^]]*]' | sort | uniq -d; }

short_recording half 120
short_recording whole 240
for name in half whole; do
  ln -s "$recording/labels" "$name/labels"
  cp "$recording"/{rgb.txt,rooms.json,objects.json} "$name"
done
expect "one run" 0 "" run whole -o one
expect "first half" 0 "" run half -o first --save-session kept
for part in map.ot scene_graph.json session.json; do
  [ -s kept/$part ] || fail "the session lacks $part"
done
cp -r kept half_way
expect "second half" 0 "" run whole -o second --resume kept --save-session kept
grep -q "120 frames the session knows already" out.txt || fail "known frames are not counted"
expect "rooms of the resumed run" 0 "" eval second/rooms.json one/rooms.json --json metrics.json
cmp -s second/map.ot one/map.ot || fail "resumed run: another map than that of one run"
[ "$(rooms second)" = "$(rooms one)" ] || { rooms one > out.txt; rooms second > err.txt; fail "resumed run: other rooms"; }
for type in NAVIGATION OBJECT DOOR; do
  [ "$(count $type one)" -gt 0 ] || fail "one run: no node of type $type"
  [ -z "$(doubled $type second)" ] || fail "resumed run: two nodes of type $type in one place"
done
# The same map and regions: the same free space stands for as many nodes, and doors are the same.
for type in NAVIGATION DOOR; do
  [ "$(count $type second)" -eq "$(count $type one)" ] ||
    fail "resumed run: $(count $type second) nodes of type $type instead of $(count $type one)"
done
more=$(($(count OBJECT second) - $(count OBJECT one)))
[ ${more#-} -le 1 ] || fail "resumed run: $more more objects than in one run"
[ "$(ls -A | grep -c part)" -eq 0 ] || fail "leftovers beside the session"

# --- What cannot be
expect "no session" 1 "does not exist" run whole -o out --resume nowhere
expect "map and session" 2 "its own map" run whole -o out --resume kept --map kept/map.ot
# As occusg/scene_graph saves it, whose map is another node's.
cp -r kept without_map && rm without_map/map.ot
sed -i -E 's/"map\.ot": ?\{[^}]*\},?//' without_map/session.json
expect "session without a map" 1 "was saved without a 3D map" run whole -o out --resume without_map
expect "check of a session without a map" 0 "" session check without_map
grep -q "is fine, but has no 3D map: --map names one when it is resumed" out.txt ||
  fail "session check does not tell that there is no map"
expect "nothing new" 1 "no frame that is younger" run half -o out --resume kept
cp -r kept damaged && head -c 1000 kept/map.ot > damaged/map.ot
expect "damaged session" 1 "damaged/map.ot: is 1000 bytes long" run whole -o other --resume damaged
[ "$(wc -l < err.txt)" -eq 1 ] || fail "more than one sentence"
[ ! -e other ] || fail "a damaged session left an output folder"
mkdir thesis && touch thesis/chapter.tex
expect "a folder that is no session" 1 "something else" run whole -o other --save-session thesis
[ ! -e other ] || fail "an output folder was made although the session cannot be saved"

# --- Results and sessions keep out of each other's way, and a run finds out before it begins
cp -r kept in_the_way
expect "results into a session" 1 "in_the_way: holds a saved session" run half -o in_the_way
expect "results of a map into a session" 1 "holds a saved session" project kept/map.ot -o in_the_way
expect "results of a batch into a session" 1 "holds a saved session" batch half -o in_the_way
diff -r kept in_the_way || fail "results into a session: the session changed"
mkdir other_session && echo '{"format": "of another program"}' > other_session/session.json
expect "a session of another program" 0 "" project kept/map.ot -o other_session
expect "session in place of the results" 1 "would replace the results in same" run half -o same --save-session same
expect "session around the results" 1 "would replace the results" run half -o around/out --save-session around/
expect "session where nothing can be written" 1 "/proc/nowhere" run half -o other --save-session /proc/nowhere/session
for folder in same around other; do
  [ ! -e $folder ] || fail "$folder was made although the session cannot be saved"
done

# --- Sessions that need repair
expect "session that is fine" 0 "" session check kept
grep -q "kept: is fine$" out.txt || fail "session check of a session with a map"
cp -r half_way future && sed -i -E 's/"stamp_s": [0-9.]+/"stamp_s": 4294967295.0/' future/session.json
expect "stamp from the future" 1 "" session check future
grep -q "from the future" out.txt || fail "session check does not tell of stamps from the future"
expect "resume a session of the future" 0 "1 stamp is from the future" run whole -o from_future --resume future
cp -r kept changed && sed -i 's/"floor_id":0/"floor_id":1/' changed/scene_graph.json
expect "resume a changed session" 1 "not what the session was saved with" run whole -o other --resume changed
expect "repair" 0 "" session repair changed
[ -s changed.unrepaired/session.json ] || fail "the session before the repair is not kept"
expect "session after its repair" 0 "" session check changed
expect "unknown action" 2 "allowed are check, repair" session mend kept

# --- What fails while saving
# The place is gone after the run has looked at it.
"$occusg" run "$recording" -o unsaved --save-session places/session > out.txt 2> err.txt < /dev/null &
pid=$!
while kill -0 $pid 2> /dev/null && [ ! -e unsaved ]; do :; done
rm -rf places && touch places
wait $pid
[ $? -eq 1 ] || fail "session that cannot be saved: exit code"
grep -qF "places" err.txt || fail "session that cannot be saved: it does not say so"
[ -s unsaved/rooms.json ] && [ -s unsaved/files.json ] || fail "no results because the session cannot be saved"
expect "results of one run" 0 "" show unsaved/scene_graph.json
echo >> unsaved/rooms.json
expect "results of two runs" 0 "not of the last that ended: rooms.json" show unsaved/scene_graph.json

finish
