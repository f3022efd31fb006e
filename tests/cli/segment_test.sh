#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# 'occusg segment' as a user meets it: exit codes, sentences, files.
# Usage: segment_test.sh OCCUSG WORK_FOLDER
set -uo pipefail
occusg=$1
work=$2
. "$(dirname "${BASH_SOURCE[0]}")/expectations.sh"

# refused NAME ERROR_TEXT ARGUMENTS...: exit code 1, one sentence, nothing written.
refused() {
  local name=$1 text=$2
  shift 2
  expect "$name" 1 "$text" segment "$@" -o out
  [ "$(wc -l < err.txt)" -eq 1 ] || fail "$name: more than one sentence"
  [ ! -e out ] || { fail "$name: an output folder was made"; rm -rf out; }
}

# repeat COUNT BYTE: COUNT bytes of the octal value BYTE.
repeat() { head -c "$1" /dev/zero | tr '\0' "\\$2"; }

# Width and height of a PNG as its header says.
png_size() { od -An -tu1 -j16 -N8 "$1" | awk '{print ($3 * 256 + $4) "x" ($7 * 256 + $8)}'; }

# A map of 190 x 90 cells at 0.05 m: two rooms of 4 m x 4 m with a door of 0.8 m near a corner.
row_of_rooms() { repeat 5 0; repeat 80 376; repeat "$1" "$2"; repeat 80 376; repeat $((25 - $1)) 0; }
write_map() {
  printf 'P5\n# two rooms\n190 90\n255\n'
  repeat $((5 * 190)) 0
  for ((y = 0; y < 80; y++)); do
    if ((y >= 56 && y < 72)); then row_of_rooms 4 376; else row_of_rooms 4 0; fi
  done
  repeat $((5 * 190)) 0
}
write_map > map.pgm
yaml() {
  printf 'image: %s\nresolution: %s\norigin: [-1.0, 2.0, %s]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n' \
    "$1" "$2" "$3"
}
yaml map.pgm 0.05 0.0 > map.yaml

# --- Help and usage
expect "help" 0 "" segment --help
grep -q "Usage: occusg segment" out.txt || fail "help does not show its form"
expect "segment without a map" 2 "MAP is missing" segment -o out
expect "segment without an output" 2 "--output" segment map.yaml
expect "unknown mode" 2 "trinary, scale or raw" segment map.yaml -o out --mode grey
expect "broken origin" 2 "X,Y" segment map.yaml -o out --origin "1;2"

# --- Good runs: every decomposer, YAML and bare picture, twice the same
for decomposer in dude constriction; do
  expect "$decomposer" 0 "" segment map.yaml -o one_$decomposer --decomposer $decomposer
  expect "$decomposer again" 0 "" segment map.yaml -o two_$decomposer --decomposer $decomposer
  for file in rooms.json rooms.geojson labels.png labels.yaml overview.png timing.json; do
    [ -s "one_$decomposer/$file" ] || fail "$decomposer: $file is missing or empty"
    [ $file = timing.json ] || cmp -s "one_$decomposer/$file" "two_$decomposer/$file" ||
      fail "$decomposer: $file differs between two runs"
  done
  [ "$(ls one_$decomposer | wc -l)" -eq 7 ] || fail "$decomposer: files left over"
  [ "$(png_size one_$decomposer/labels.png)" = 190x90 ] || fail "$decomposer: labels.png has another size"
  [ "$(grep -c '"id":' one_$decomposer/rooms.json)" -eq 2 ] || fail "$decomposer: not two rooms"
  grep -qF '"rooms":[1,2]' one_$decomposer/rooms.json || fail "$decomposer: no door between the rooms"
  grep -qF '[-0.75,2.25]' one_$decomposer/rooms.json || fail "$decomposer: the origin is not honoured"
  grep -q '"decomposition": {"count": 1' one_$decomposer/timing.json || fail "$decomposer: timing.json"
done
# A map of Nav2's map_saver: 205 is unknown, and its YAML says that it is free.
{ head -c 26 map.pgm | sed 's/190 90/190 91/'; tail -c +27 map.pgm; repeat 190 315; } > more.pgm
sed 's/map.pgm/more.pgm/; s/0.196/0.25/' map.yaml > nav2.yaml
expect "unknown grey" 0 "grey 205 (1 % of the pixels) counts as unknown" segment nav2.yaml -o nav2
[ "$(grep -c '"id":' nav2/rooms.json)" -eq 2 ] || fail "unknown grey: not two rooms"
refused "unknown grey, strict" "without --strict this is assumed" nav2.yaml --strict
{ cat map.pgm; repeat 7 376; } > longer.pgm
expect "bytes behind the pixels" 0 "longer.pgm: 7 bytes follow the picture's last pixel and were left out" \
  segment longer.pgm -o longer --resolution 0.05
refused "bytes behind the pixels, strict" "7 bytes follow" longer.pgm --resolution 0.05 --strict
{ cat map.pgm; echo; } > with_newline.pgm
expect "a line end behind the pixels" 0 "" segment with_newline.pgm -o with_newline --resolution 0.05
expect "bare picture" 0 "" segment map.pgm -o bare --resolution 0.05
grep -qF '[0.25,0.25]' bare/rooms.json || fail "a bare picture does not begin at (0, 0)"
expect "origin" 0 "" segment map.pgm -o moved --resolution 0.05 --origin 0.01,0
grep -qF '[0.26,0.25]' moved/rooms.json || fail "an origin between cells is not honoured"
expect "labels are evaluated as the rooms" 0 "" eval bare/labels.png bare/rooms.json --resolution 0.05
grep -qE '0.75 +1.000 +1.000 +1.000 +1.000' out.txt || fail "labels.png and rooms.json differ"
expect "drawing" 0 "" segment map.yaml -o drawn --decomposer dude --d-thr 1.5 --debug-drawing steps.png
[ -s steps.png ] || fail "no drawing"
expect "drawing of rooms of another decomposer" 0 "so the rooms are those of dude" \
  segment map.yaml -o drawn_too --debug-drawing steps.png
cmp -s one_dude/rooms.json drawn_too/rooms.json || fail "drawing: the rooms are not those of dude"
expect "deep threshold" 0 "" segment map.yaml -o deep --d-thr 30
[ "$(grep -c '"id":' deep/rooms.json)" -eq 1 ] || fail "--d-thr changes nothing"

# --- Options that do not fit
refused "threshold of another decomposer" "dude" map.yaml --decomposer constriction --d-thr 2
refused "drawing of another decomposer" "dude" map.yaml --decomposer constriction --debug-drawing a.png
[ ! -e a.png ] || fail "a drawing was written"
expect "drawing of another kind" 2 "ends in .png" segment map.yaml --decomposer dude --debug-drawing a.jpg -o out
refused "unknown decomposer" "allowed is" map.yaml --decomposer magic
refused "negative threshold" "--d-thr" map.yaml --decomposer dude --d-thr -1
refused "thresholds the wrong way round" "free_thresh < occupied_thresh" map.yaml --free-thresh 0.7
refused "threshold out of range" "occupied_thresh <= 1" map.yaml --occupied-thresh 1.5
refused "no scale" "--resolution" map.pgm
refused "zero resolution" "resolution of 0" map.pgm --resolution 0
refused "negative resolution" "resolution of -0.05" map.pgm --resolution=-0.05
refused "resolution that is no number" "resolution of nan" map.pgm --resolution nan
expect "resolution with a comma" 2 "--resolution is '0,05'; a number, as in 0.05, is needed" segment map.pgm --resolution 0,05 -o out
expect "a negative number of cells" 2 "--max-cells is -1; a number from 1 to" segment map.yaml --max-cells -1 -o out
refused "more cells than allowed" "--max-cells" map.yaml --max-cells 1000
expect "labels without a scale" 1 "--resolution" eval bare/labels.png bare/rooms.json

# --- Results do not take the place of what is read
mkdir inputs && cp map.pgm inputs/overview.png && sed 's/map.pgm/overview.png/' map.yaml > inputs/labels.yaml
cp -r inputs untouched
for map in "inputs/overview.png --resolution 0.05" inputs/labels.yaml; do
  expect "results over $map" 1 "of the results would replace it" segment $map -o inputs
done
expect "picture of a YAML elsewhere" 1 "overview.png of the results would replace it" \
  segment "$(sed 's/map.pgm/inputs\/overview.png/' map.yaml > outside.yaml; echo outside.yaml)" -o inputs
expect "drawing over the map" 1 "is read and would be written over" \
  segment inputs/labels.yaml -o drawn_over --debug-drawing inputs/overview.png
diff -r inputs untouched || fail "results over a map: the map changed"
[ ! -e drawn_over ] || fail "an output folder was made although the drawing would replace the map"

# --- Bad maps
refused "missing map" "nowhere.yaml" nowhere.yaml
yaml gone.pgm 0.05 0 > no_picture.yaml
refused "missing picture" "no_picture.yaml:1: image is 'gone.pgm', which does not exist" no_picture.yaml
# Without a scale, too, the file is looked at first.
refused "missing bare picture" "nowhere.png: does not exist" nowhere.png
refused "empty name" "the map: has an empty name" ""
mkdir folder.pgm && refused "folder" "folder.pgm: is a folder" folder.pgm
printf '# Octomap OcTree binary file\nid OcTree\n' > building.bt
refused "3D map" "building.bt: is an OctoMap; 'occusg project' reads it" building.bt
printf 'rooms\n' > rooms.txt
refused "no picture and no scale" "rooms.txt: is no picture that is read" rooms.txt
printf '\211PNG\r\n\032\n' > cut.png
refused "picture cut in its header" "cut.png: ends before it says its size" cut.png --resolution 0.05
cp map.yaml map_without_ending && cp map.yaml UPPER.YAML
for name in map_without_ending UPPER.YAML; do
  expect "$name" 0 "" segment $name -o "out_$name"
  cmp -s one_dude/labels.yaml "out_$name/labels.yaml" || fail "$name is not read as YAML"
done
yaml map.pgm -1 0 > negative.yaml
refused "negative resolution in YAML" "negative.yaml" negative.yaml
yaml map.pgm .nan 0 > nan.yaml
refused "NaN in YAML" "nan.yaml:2: resolution is '.nan'" nan.yaml
yaml map.pgm 0.05 0.5 > turned.yaml
expect "turned map" 0 "" segment turned.yaml -o turned
grep -qF '[-0.9005,2.3393]' turned/rooms.json || fail "a turned origin is not honoured"
grep -qF 'origin: [-1, 2, 0.5]' turned/labels.yaml || fail "labels.yaml: the origin is wrong"
grep -v free_thresh map.yaml > no_threshold.yaml
refused "unknown thresholds" "has no free_thresh" no_threshold.yaml
sed 's/free_thresh: .*/free_thresh: low/' map.yaml > word.yaml
refused "threshold that is no number" "word.yaml:6: free_thresh is 'low'" word.yaml
printf 'P5 65000 65000 255\n' > huge.pgm
refused "huge PGM" "65000 x 65000 = 4225000000 cells; at most 100000000 are read (--max-cells" huge.pgm --resolution 0.05
printf '\211PNG\r\n\032\n\0\0\0\015IHDR\0\0\375\350\0\0\375\350\010\0\0\0\0' > huge.png
refused "huge PNG" "65000 x 65000" huge.png --resolution 0.05
refused "picture of labels" "labels.png: has no free cell" bare/labels.png --resolution 0.05
{ printf 'P5 4 4 255\n'; repeat 16 0; } > full.pgm
refused "no free cell" "full.pgm: has no free cell" full.pgm --resolution 0.05
{ printf 'P5 4 4 255\n'; repeat 9 376; } > short.pgm
refused "truncated picture" "short.pgm: ends before its last pixel" short.pgm --resolution 0.05
printf 'hello' > hello.png
refused "no picture" "is no picture that is read" hello.png --resolution 0.05
touch a_file
expect "output that is a file" 1 "a_file" segment map.yaml -o a_file

finish
