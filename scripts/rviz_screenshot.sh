#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Plays the demo into rviz on a virtual screen, waits until its rooms are drawn, and takes a
# picture; fails when the picture is blank. Needs scripts/build.sh to have run.
# Usage: scripts/rviz_screenshot.sh OUT.png
set -euo pipefail
if [ $# -ne 1 ]; then
  echo "usage: scripts/rviz_screenshot.sh OUT.png" >&2
  exit 2
fi
picture=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [ -z "${OCCUSG_VIRTUAL_SCREEN:-}" ]; then
  export OCCUSG_VIRTUAL_SCREEN=1
  exec xvfb-run -a -s "-screen 0 1280x800x24 +extension GLX" "${BASH_SOURCE[0]}" "$picture"
fi

set +u
# shellcheck disable=SC1091
. devel/setup.bash
set -u
work=$(mktemp -d)
port=$(/usr/bin/python3 -c \
  'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
export ROS_MASTER_URI=http://127.0.0.1:$port ROS_HOSTNAME=127.0.0.1 ROS_HOME=$work
export XDG_RUNTIME_DIR=$work LIBGL_ALWAYS_SOFTWARE=1 QT_QPA_PLATFORM=xcb
chmod 700 "$work"

roslaunch -p "$port" occusg demo.launch rate:=4 > "$work/launch.log" 2>&1 &
launch=$!
finish() {
  kill -INT $launch 2> /dev/null || true
  wait $launch || true
  rm -rf "$work"
}
trap finish EXIT

rooms() {
  timeout 10 rosservice call /occusg/list_rooms "min_area: 0.0" 2> /dev/null | grep -c ' id:' || true
}

for _ in $(seq 60); do
  sleep 3
  if ! kill -0 $launch 2> /dev/null; then
    cat "$work/launch.log" >&2
    echo "rviz_screenshot.sh: the demo has ended too early" >&2
    exit 1
  fi
  # The player goes when the recording has ended.
  if [ "$(rooms)" -ge 5 ] && ! timeout 10 rosnode list 2> /dev/null | grep -q player; then
    break
  fi
done
found=$(rooms)
sleep 8 # until the last frame of software OpenGL is on the screen
import -window root "$work/screen.png"
convert "$work/screen.png" -dither None -colors 250 "PNG8:$picture"

colors=$(identify -format %k "$work/screen.png")
# Share of strong colours: rooms are coloured, a blank view is grey.
colorful=$(convert "$work/screen.png" -colorspace HSL -channel S -separate +channel \
  -threshold 30% -format '%[fx:int(1000*mean)]' info:)
echo "rviz_screenshot.sh: $found rooms, $colors colours, $colorful/1000 of the picture coloured"
if [ "$found" -lt 5 ] || [ "$colors" -lt 500 ] || [ "$colorful" -lt 20 ]; then
  cat "$work/launch.log" >&2
  echo "rviz_screenshot.sh: the picture is blank" >&2
  exit 1
fi
