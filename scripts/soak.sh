#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Plays the recording of examples/ in a loop for ten minutes, ten times as fast as recorded, with an autosave every second,
# and fails when the process that holds all nodelets grows by more than 10 MB after the first minute.
# Usage: scripts/soak.sh [SECONDS] [MOST_MB]      after scripts/test.sh or scripts/build.sh --ros
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
seconds=${1:-600}
most_mb=${2:-10}
. "$root/scripts/environment.sh"
set +u
# shellcheck disable=SC1091
. "$root/devel/setup.bash"
set -u
work=$(mktemp -d)
port=$((20000 + RANDOM % 10000))
export ROS_MASTER_URI=http://127.0.0.1:$port ROS_HOME=$work ROS_IP=127.0.0.1
# A busy machine takes longer to start the master than roslaunch waits for it.
rosmaster --core -p "$port" > "$work/master.log" 2>&1 &
master=$!
for ((waited = 0; waited < 120; waited++)); do
  if rosparam list > /dev/null 2>&1; then break; fi
  sleep 1
done
roslaunch occusg replay.launch sequence:="$root/examples/apartment" rate:=10 loop:=true hold:=1 \
  autosave_period_s:=1.0 save_folder:="$work/saved" > "$work/roslaunch.log" 2>&1 &
launch=$!
trap 'kill -INT $launch 2> /dev/null; wait $launch 2> /dev/null || true; kill $master 2> /dev/null; rm -rf --one-file-system "$work"' EXIT

# Resident memory of the manager [MB].
resident() {
  local pid
  pid=$(pgrep -f "__name:=manager __log:=$work/" | head -n 1) || return 1
  awk '/^VmRSS/ {print int($2 / 1024)}' "/proc/$pid/status"
}
for ((waited = 0; waited < 60; waited++)); do
  resident > /dev/null 2>&1 && break
  sleep 1
done
first=
for ((second = 0; second <= seconds; second += 10)); do
  if ! now=$(resident) || [ -z "$now" ]; then
    echo "soak.sh: the nodelets' process is gone after $second s; the end of its log:" >&2
    tail -n 20 "$work/roslaunch.log" >&2
    exit 1
  fi
  if [ "$second" -eq 60 ]; then first=$now; fi
  printf '%4d s  %4d MB\n' "$second" "$now"
  sleep 10
done
grown=$((now - ${first:-$now}))
saves=$(find "$work/saved" -name map.ot | wc -l)
if [ "$saves" -eq 0 ]; then
  echo "soak.sh: nothing was saved" >&2
  exit 1
fi
if [ "$grown" -gt "$most_mb" ]; then
  echo "soak.sh: the process grew by $grown MB after the first minute; at most $most_mb MB are allowed" >&2
  exit 1
fi
echo "the process grew by $grown MB after the first minute."
