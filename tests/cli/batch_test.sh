#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# 'occusg batch', 'ablate', 'merge' and 'truth' as a user meets them: rows, resuming, crashes, shards.
# Usage: batch_test.sh OCCUSG RECORDING WORK_FOLDER SLURM_SCRIPT HOUSE
set -uo pipefail
occusg=$1
recording=$2
work=$3
slurm_script=$4
house=$5
. "$(dirname "${BASH_SOURCE[0]}")/expectations.sh"

# short_recording NAME FRAMES: the first frames of the recording with its truth, images shared.
short_recording() {
  mkdir -p "$1"
  cp "$recording"/camera.json "$recording"/groundtruth.txt "$recording"/rooms.json "$1"
  head -n $(($2 + 1)) "$recording/depth.txt" > "$1/depth.txt"
  ln -s "$recording/depth" "$1/depth"
}
# row OUT CONFIGURATION SCENE STATUS: whether results.csv has it.
row() { grep -q "^$2,$3,$4," "$1/results.csv" || fail "no row '$2,$3,$4' in $1/results.csv"; }

short_recording rec/a 8
short_recording rec/b 8
mkdir -p hydra
sed 's/"id":[0-9]*/"id":"R"/' rec/a/rooms.json | sed 's/"doors":.*\],"objects"/"objects"/' > hydra/a.json

# --- Help and usage
for command in batch ablate merge truth; do
  expect "$command --help" 0 "" $command --help
  grep -q "Usage: occusg $command" out.txt || fail "$command --help does not show its form"
done
expect "no sequence" 2 "SEQUENCE is missing" batch -o out
expect "no jobs" 2 "--jobs is 0" batch rec/a -o out --jobs 0
expect "shard out of range" 2 "1 <= K <= N" batch rec/a -o out --shard 3/2
expect "external without a name" 2 "NAME=FOLDER" batch rec/a -o out --external hydra
expect "external without a folder" 1 "no folder" batch rec/a -o out --external hydra=nowhere
expect "two scenes of one name" 1 "different names" batch rec/a hydra/../rec/a -o out
expect "configuration twice" 1 "given twice" batch rec/a -o out --config paper --config paper
expect "unknown configuration" 1 "nowhere.yaml" batch rec/a -o out --config nowhere.yaml
expect "unknown parameter" 1 "did you mean" ablate rec/a -o out --param regions.dude.depth_treshold_m=1
expect "nothing to vary" 2 "--param" ablate rec/a -o out
expect "value out of range" 1 "depth_threshold_m" ablate rec/a -o out --d-thr 1,-3
[ ! -e out ] || fail "an output folder was made although the command was wrong"

# --- Rows of every kind; one bad recording does not stop the others
mkdir rec/broken
expect "batch" 1 "default/broken failed: " batch rec/* -o one --jobs 2 --config default --external hydra=hydra
for file in results.csv results.json report.html batch.json; do
  [ -s "one/$file" ] || fail "$file is missing or empty"
done
row one default a done
row one default b done
row one default broken failed
row one hydra a done
row one hydra b missing
grep -q "rec/broken: " one/results.csv || fail "the reason of the failure is not in the row"
grep -q "about .* left" out.txt || fail "no remaining time"

# --- Started again: what is finished is kept
before=$(stat -c %Y%i one/default/a/rooms.json)
expect "again" 1 "broken" batch rec/* -o one --jobs 2 --config default --external hydra=hydra
grep -q "6 runs, 3 of them finished before" out.txt || fail "finished scenes are run again"
[ "$before" = "$(stat -c %Y%i one/default/a/rooms.json)" ] || fail "a finished scene was run again"
rm -r rec/broken
printf 'regions:\n  period_s: 0.7\n' > default.yaml
expect "other parameters" 0 "" batch rec/a -o one --config default.yaml
grep -q "^1 run, 0 of them finished" out.txt || fail "a run with other parameters is not run again"

# --- Shards, merged, give the same tables
expect "whole" 0 "" batch rec/a rec/b -o whole --config default --decomposer dude
expect "shard 1" 0 "" batch rec/a rec/b -o node1 --config default --decomposer dude --shard 1/2
grep -q "occusg merge" out.txt || fail "a shard does not say what to do next"
[ ! -e node1/report.html ] || fail "a shard wrote a report"
expect "merge of a part" 0 "" merge node1 -o part
row part dude b missing
SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_COUNT=2 SLURM_CPUS_PER_TASK=2 OCCUSG=$occusg \
  "$slurm_script" node2 rec/a rec/b --config default --decomposer dude > out.txt 2> err.txt || fail "Slurm script"
[ -e node2/dude/b/rooms.json ] && [ ! -e node2/dude/a ] || fail "Slurm task 2 of 2 did not run scene b alone"
env -u SLURM_ARRAY_TASK_ID OCCUSG="$occusg" "$slurm_script" node3 rec/a > out.txt 2> err.txt
[ $? -eq 2 ] && grep -q "sbatch --array" err.txt || fail "Slurm script outside of an array"
expect "merge" 0 "" merge node1 node2 -o merged
# Times of the stages and of the run differ; everything before them must not.
for table in whole merged; do cut -d, -f1-4,6-70 $table/results.csv > $table.cut; done
cmp -s whole.cut merged.cut || fail "merged shards give another table than the whole"
expect "merge of no batch" 1 "batch.json" merge rec -o out

# --- Time-outs and crashes are rows
expect "time-out" 1 "default/a timed out" batch rec/a -o slow --timeout 0.001
row slow default a "timed out"
short_recording long/c 300
"$occusg" batch long/c rec/a -o crash > out.txt 2> err.txt < /dev/null &
pid=$!
child=
while [ -z "$child" ] && kill -0 $pid 2> /dev/null; do child=$(cat /proc/$pid/task/$pid/children 2> /dev/null); done
kill -SEGV $child
wait $pid
[ $? -eq 1 ] || fail "crash: exit code"
row crash default c failed
row crash default a done
grep -q "signal 11" crash/results.csv || fail "the signal is not named"

# --- Ctrl-C ends the runs and says how to go on
"$occusg" batch long/c -o cut > out.txt 2> err.txt < /dev/null &
pid=$!
child=
while [ -z "$child" ] && kill -0 $pid 2> /dev/null; do child=$(cat /proc/$pid/task/$pid/children 2> /dev/null); done
kill -INT $pid
wait $pid
[ $? -eq 1 ] || fail "Ctrl-C: exit code"
grep -q "the same command continues" err.txt || fail "Ctrl-C: it does not say so"
[ ! -e "/proc/${child% }" ] || fail "Ctrl-C: the run goes on"

# --- Ablation: a row a value
expect "ablate" 0 "" ablate rec/a -o ablation --d-thr 1.5,30
row ablation depth_threshold_m=1.5 a done
row ablation depth_threshold_m=30 a done
grep -q "depth_threshold_m=30 " out.txt || fail "the table is not printed"
grep -q "decomposer: dude" "ablation/depth_threshold_m=30/a/config.yaml" || fail "dude is not the decomposer"

# --- Truth of a Matterport3D house
expect "truth" 0 "region 4 has no footprint" truth mp3d "$house" -o house.json
grep -q "4 rooms, 1 door in" out.txt || fail "truth: counts"
expect "truth of one level" 1 "level 9" truth mp3d "$house" -o level.json --level 9
expect "unknown format" 2 "mp3d" truth scannet "$house" -o level.json
expect "eval of a house against itself" 0 "" eval house.json house.json

finish
