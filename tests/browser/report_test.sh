#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# report.html in a browser: the tables and pictures are there and drawn, and nothing is loaded.
# Usage: report_test.sh OCCUSG RECORDING WORK_FOLDER
set -uo pipefail
occusg=$1
recording=$2
work=$3
. "$(dirname "${BASH_SOURCE[0]}")/../cli/expectations.sh"
browser=$(command -v chromium chromium-browser google-chrome | head -n 1)
if [ -z "$browser" ]; then
  touch out.txt err.txt
  fail "no browser: chromium, chromium-browser or google-chrome is needed"
  finish
fi

# External predictions need no run: the truth itself, and the truth without its last room.
mkdir -p recordings/flat truth cut home
cp "$recording/rooms.json" recordings/flat/rooms.json
cp "$recording/rooms.json" truth/flat.json
/usr/bin/python3 -c '
import json, sys
rooms = json.load(open(sys.argv[1]))["rooms"]
json.dump({"rooms": rooms[:-1]}, open(sys.argv[2], "w"))' truth/flat.json cut/flat.json
expect "batch" 0 "" batch recordings/flat -o out --external truth=truth --external cut=cut

export HOME=$PWD/home
page=file://$PWD/out/report.html
open_page() { timeout 100 "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$PWD/profile" "$@" "$page"; }
open_page --dump-dom > dom.html 2> browser.log || fail "the browser cannot open the page"
for table in macro micro difference scenes-15 scenes-50 scenes-75 segmentation relations; do
  grep -q "<table id=\"$table\"" dom.html || fail "table $table is missing"
done
[ "$(grep -o '<svg role="img"' dom.html | wc -l)" -ge 4 ] || fail "pictures are missing"
grep -q '<tr><th scope="row">flat</th><td>[0-9]*</td><td class="best group">1.00</td>' dom.html ||
  fail "the row of the scene is not as expected"
! grep -qE '<script|src=|href="[^#]|url\(h|@import' dom.html || fail "the page loads something"

# A picture of the page must hold the green, blue and red of drawn rooms, not an empty sheet.
open_page --hide-scrollbars --window-size=1200,4000 --screenshot="$PWD/page.png" > out.txt 2> err.txt
[ -s page.png ] || fail "no screenshot"
[ "$(stat -c %s page.png 2> /dev/null || echo 0)" -gt 50000 ] || fail "the page is empty"
: > out.txt
: > err.txt
finish
