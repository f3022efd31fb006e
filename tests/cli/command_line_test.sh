#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The command line as a user meets it: exit codes, sentences, files.
# Usage: command_line_test.sh OCCUSG RECORDING WORK_FOLDER
set -uo pipefail
occusg=$1
recording=$2
work=$3
. "$(dirname "${BASH_SOURCE[0]}")/expectations.sh"

short_recording short 24

# --- Help and usage
expect "help" 0 "" --help
for command in run segment project show eval config; do
  expect "$command --help" 0 "" $command --help
  grep -q "Usage: occusg $command" out.txt || fail "$command --help does not show its form"
done
expect "version" 0 "" --version
grep -qE '^occusg [0-9]+\.[0-9]+\.[0-9]+(, commit [0-9a-f]+(-dirty)?)?, (Release|Debug) build$' out.txt || fail "version"
for command in run segment project show eval config; do
  expect "help $command" 0 "" help $command
  grep -q "Usage: occusg $command" out.txt || fail "help $command does not show its form"
done
expect "help for a misspelt command" 2 "did you mean 'segment'" help segmnt
expect "no command" 2 "no command given"
expect "misspelt command" 2 "did you mean 'eval'" evl
expect "two letters of a command swapped" 2 "unknown command 'rnu'; did you mean 'run'?" rnu
expect "misspelt option of the program" 2 "unknown option '--versoin'; did you mean '--version'?" --versoin
expect "too much after help" 2 "'extra' is one argument too many for 'help'" help run extra
expect "too much after --version" 2 "'extra' is one argument too many for '--version'" --version extra
expect "an empty value among others" 2 "are '1,,2'; one is empty" ablate short -o out --d-thr 1,,2
expect "run without a sequence" 2 "SEQUENCE is missing" run -o out
expect "run without an output" 2 "--output is missing (folder for the results" run short
expect "unknown option" 2 "unknown option '--fast' (see 'occusg help run')" run short -o out --fast
expect "misspelt option" 2 "did you mean '--config'?" run short -o out --confg paper
expect "option without its value" 2 "--config needs a value: 'default', 'paper' or a YAML file" run short -o out --config
expect "empty question" 2 "--query is ''; allowed are" show none --query ""
expect "question without text" 2 "--query needs a value: answer this" show none --query=
expect "number beyond the range" 2 "--jobs is '99999999999'; a whole number from" batch short -o out --jobs 99999999999
expect "option given twice" 2 "is given more than once" run short -o out -o other
expect "too many arguments" 2 "too many arguments" run short short -o out
expect "config without --print" 2 "--print" config
expect "unknown alignment" 2 "centroid" eval short short --align sideways

# --- Configuration
expect "config --print" 0 "" config --print
cp out.txt printed.yaml
expect "printed configuration is accepted" 0 "" config --print --config printed.yaml
cmp -s out.txt printed.yaml || fail "a printed configuration does not read back unchanged"
printf 'perception:\n  depth:\n    strid: 3\n' > typo.yaml
expect "unknown key" 1 "typo.yaml:3: unknown key 'perception.depth.strid'; did you mean 'perception.depth.stride'" \
  run short -o out --config typo.yaml
expect "unknown decomposer" 1 "allowed is" run short -o out --decomposer magic
[ ! -e out ] || fail "an output folder was made although the configuration was wrong"

# --- What cannot be printed is no success
if "$occusg" config --print > /dev/full 2> err.txt; then fail "full standard output: exit code 0"; fi
grep -qF "standard output: cannot be written" err.txt || fail "full standard output: no sentence"

# --- Results do not replace the annotation of the recording
short_recording annotated 2
cp "$recording/rooms.json" annotated
expect "results into the recording" 1 "is the folder of the recording" run annotated -o annotated
cmp -s "$recording/rooms.json" annotated/rooms.json || fail "results into the recording: the annotation changed"
expect "--param" 0 "" config --print --param regions.decomposer=dude --param perception.depth.stride=2
grep -q 'decomposer: dude' out.txt || fail "--param did not set a name"
grep -q 'stride: 2' out.txt || fail "the second --param did not set a number"
expect "--param without a value" 2 "KEY=VALUE is needed" run short -o out --param regions.decomposer
expect "--param of a key like no other" 1 "unknown key 'foo'; 'occusg config --print' lists the keys" \
  run short -o out --param foo=2
expect "--param of an unknown key" 1 "did you mean 'perception.depth.stride'" \
  run short -o out --param perception.depth.strid=2
expect "--frames that is no range" 2 "A:B is needed" run short -o out --frames 7
expect "--frames beyond the recording" 1 "frames 0 to 23 are there" run short -o out --frames 24:
[ ! -e out ] || fail "an output folder was made for frames that are not there"
expect "--frames" 0 "" run short -o some --frames 4:9
grep -q "  5 frames, " out.txt || fail "--frames did not read five frames"

# --- Completion, as bash asks for it
completion=$(dirname "${BASH_SOURCE[0]}")/../../occusg_core/apps/completion/occusg
complete_words() { # WORDS...: what completes the last word
  bash -c '. "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _occusg "$1"; echo "${COMPREPLY[*]}"' \
    bash "$completion" "$occusg" "$@"
}
[ "$(complete_words seg)" = segment ] || fail "completion of a command"
[ "$(complete_words help ru)" = run ] || fail "completion of help"
[ "$(complete_words run short --dec)" = --decomposer ] || fail "completion of an option"

# --- A good run, twice: all files, identical results
expect "run" 0 "" run short -o one
expect "run again" 0 "" run short -o two
for file in rooms.json scene_graph.json scene_graph.dsg.json scene_graph.graphml rooms.geojson free_space.pgm free_space.yaml \
  map.ot overview.png timing.json files.json; do
  [ -s "one/$file" ] || fail "$file is missing or empty"
  case $file in timing.json | files.json) continue ;; esac
  cmp -s "one/$file" "two/$file" || fail "$file differs between two runs"
done
[ "$(ls one | wc -l)" -eq 11 ] || fail "files left over in the output folder"
expect "eval" 0 "" eval one/rooms.json "$recording/rooms.json" --json metrics.json
[ -s metrics.json ] || fail "eval --json wrote nothing"
cat > truth_storeys.json << 'END'
{"storeys": [{"id": 0, "floor_z": -2.8}, {"id": 1, "floor_z": 0.0}], "rooms": [
 {"id": 1, "storey": 0, "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]]},
 {"id": 2, "storey": 1, "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]]}]}
END
cat > storeys.json << 'END'
{"storeys": [{"id": 0, "floor_z": 0.1}, {"id": 1, "floor_z": 3.0}], "rooms": [
 {"id": 1, "storey": 0, "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]]},
 {"id": 2, "storey": 1, "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]]}]}
END
cat > elsewhere.json << 'END'
{"rooms": [{"id": 1, "polygon": [[90, 0], [94, 0], [94, 4], [90, 4]]}]}
END
expect "eval of two frames" 0 "no predicted room overlaps an annotated one" eval elsewhere.json "$recording/rooms.json"
grep -qF "A PNG lies with its lower left corner at (0, 0)" err.txt || fail "eval of two frames: where a PNG lies is not told"
expect "a scale without a PNG" 2 "neither side is a PNG" eval one/rooms.json "$recording/rooms.json" --resolution -1
expect "eval storey by storey" 0 "" eval storeys.json truth_storeys.json
grep -q "storey at 3.00 m: predicted rooms: 1, none annotated there" out.txt || fail "eval: the storey without truth is not told"
grep -q "0.50  0.500  0.500  0.500" out.txt || fail "eval: a room of another storey was matched"
cp one/rooms.json rooms_kept.json
expect "metrics over what is read" 1 "one/../one/rooms.json: is read and would be written over" \
  eval one/rooms.json "$recording/rooms.json" --json one/../one/rooms.json
cmp -s one/rooms.json rooms_kept.json || fail "metrics over what is read: the rooms changed"
expect "truth over what is read" 1 "is read and would be written over" truth mp3d one/rooms.json -o one/rooms.json
expect "eval of a missing file" 1 "nowhere.json" eval nowhere.json one/rooms.json

# --- Bad input: one sentence that names the file
expect "missing sequence" 1 "nowhere" run nowhere -o out
short_recording no_poses 4 && rm no_poses/groundtruth.txt
expect "missing poses" 1 "no_poses/groundtruth.txt" run no_poses -o out
short_recording flat 4 && sed -i 's/"fx": [0-9.]*/"fx": 0/' flat/camera.json
expect "zero focal length" 1 "flat/camera.json" run flat -o out
short_recording empty 0
expect "empty sequence" 1 "empty/depth.txt" run empty -o out
[ ! -e out ] || fail "an output folder was made for a sequence that cannot be read"
touch a_file
expect "output that is a file" 1 "a_file" run short -o a_file
expect "output below a file" 1 "a_file" run short -o a_file/below

expect "a model without class names" 1 "--model: stands alone" run short -o out --model model.onnx
printf 'den\n  sofa\n' > labels.yaml
expect "a table of labels that is none" 1 "labels.yaml:1" run short -o out --room-labels labels.yaml

# --- Bad frames: skipped and counted, fatal when asked for or when they are most
short_recording spoilt 12
sed -i '5s/.*/not-a-time depth\/000003.png/' spoilt/depth.txt
expect "one bad frame" 0 "skipped 1 of 12 frames" run spoilt -o spoilt_out
grep -qF "spoilt/depth.txt:5" err.txt || fail "the bad line is not named"
expect "one bad frame, strict" 1 "spoilt/depth.txt:5" run spoilt -o strict_out --strict
short_recording hopeless 12
sed -i '3,10s/ depth/ nowhere/' hopeless/depth.txt
expect "most frames bad" 1 "8 of 12 frames" run hopeless -o hopeless_out
[ -z "$(ls hopeless_out 2> /dev/null)" ] || fail "a failed run wrote results"

# --- The unit of the depth images
expect "depth in metres" 1 "24 of 24 frames have no pixel with a depth" run short -o out_metres --depth-scale 1
grep -qF -- "is --depth-scale, the pixel value of one metre, right?" err.txt || fail "depth in metres: the likely reason is not named"
[ -z "$(ls out_metres 2> /dev/null)" ] || fail "a run without any depth wrote results"
expect "depth ten times too short" 0 "most depths are below 0.5 m: is the unit of the depth images right (--depth-scale)?" \
  run short -o out_near --depth-scale 10000
grep -qF "no rooms" err.txt || fail "depth ten times too short: there should be no rooms"

# --- Poses of other systems: what is wrong is seen, and the named option mends it
poses_of() { python3 "$(dirname "${BASH_SOURCE[0]}")/other_world_poses.py" "$1" "$recording/groundtruth.txt"; }
rooms_in() { grep -c '"id"' "$1/rooms.json"; }
short_recording whole 400
expect "the recording as it is" 0 "" run whole -o as_it_is
short_recording slam 400 && poses_of first-camera > slam/groundtruth.txt
expect "the world is the first camera" 0 "degrees away from the map's -z: is z up? --level" run slam -o out_slam
expect "the same, strict" 1 "is z up?" run slam -o out_strict --strict
short_recording hung 400 && poses_of upside-down > hung/groundtruth.txt
expect "a camera upside down" 0 "unless the camera was mounted upside down: then nothing is to be done" run hung -o out_hung
expect "--level" 0 "levelled: the map was turned by" run slam -o level --level
[ "$(rooms_in level)" -eq "$(rooms_in as_it_is)" ] || fail "--level does not find the rooms again"
short_recording body 400 && poses_of body > body/groundtruth.txt
expect "poses of the body" 0 "with --pose-frame body it would be" run body -o out_body
expect "--pose-frame body" 0 "" run body -o body_mended --pose-frame body
cmp -s as_it_is/rooms.json body_mended/rooms.json || [ "$(rooms_in body_mended)" -eq "$(rooms_in as_it_is)" ] ||
  fail "--pose-frame body does not find the rooms again"
short_recording wxyz 400 && poses_of w-first > wxyz/groundtruth.txt
expect "quaternions with w first" 0 "with --quaternion wxyz it would be" run wxyz -o out_wxyz
expect "--quaternion wxyz" 0 "" run wxyz -o wxyz_mended --quaternion wxyz
[ "$(rooms_in wxyz_mended)" -eq "$(rooms_in as_it_is)" ] || fail "--quaternion wxyz does not find the rooms again"
short_recording low 400 && poses_of low > low/groundtruth.txt
expect "the floor is far below zero" 0 "the lowest floor that was seen is 3.0 m below z = 0" run low -o out_low
short_recording sparse 400 && poses_of sparse > sparse/groundtruth.txt
expect "fewer poses than images" 0 "interpolated between poses at most 1.0 s, 0.5 m and 30 degrees apart" \
  run sparse -o out_sparse
expect "poses in another file" 0 "" run sparse -o other --poses whole/groundtruth.txt
cmp -s as_it_is/rooms.json other/rooms.json && fail "the scene's name should differ"
[ "$(rooms_in other)" -eq "$(rooms_in as_it_is)" ] || fail "--poses does not give the rooms again"
mv sparse/groundtruth.txt sparse/KeyFrameTrajectory.txt
expect "poses under another name" 1 "name the poses with --poses; the folder holds 'KeyFrameTrajectory.txt'" \
  run sparse -o out_other
expect "a bag in place of a folder" 1 "occusg_bag" run "$(touch run.bag; echo run.bag)" -o out_bag

# --- Ctrl-C: ends the run, writes what is there, says so
"$occusg" run "$recording" -o cut > out.txt 2> err.txt < /dev/null &
pid=$!
while kill -0 $pid 2> /dev/null && ! grep -q SigCgt /proc/$pid/status 2> /dev/null; do :; done
# Wait until the handler of signal 2 is in place, not for a time.
while kill -0 $pid 2> /dev/null &&
  [ $((0x$(sed -n 's/^SigCgt:[[:space:]]*//p' /proc/$pid/status 2> /dev/null || echo 2) & 2)) -eq 0 ]; do :; done
kill -INT $pid
wait $pid
[ $? -eq 1 ] || fail "Ctrl-C: exit code"
grep -qF "interrupted after" err.txt || fail "Ctrl-C: it does not say so"
[ -s cut/rooms.json ] || fail "Ctrl-C: what was found is not written"

finish
