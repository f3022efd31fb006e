#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs clang-tidy over the sources, with ROS when scripts/build.sh has built it. It reads the batches of files that a
# build compiles, as most of the time goes into the headers they share.
# Usage: scripts/check_tidy.sh
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
sources=('occusg_core/*.cpp')
with_ros=OFF
# The messages' headers must have been generated.
if [ -d devel/include/occusg ]; then
  sources+=('occusg_ros/*.cpp')
  with_ros=ON
fi
# shellcheck source=scripts/environment.sh
. scripts/environment.sh
# Configured apart and never built.
cmake -S . -B build/tidy -G Ninja -DCMAKE_BUILD_TYPE=Release -DOCCUSG_UNITY_BUILD=ON -DOCCUSG_BUILD_ROS=$with_ros \
  -DOCCUSG_BUILD_TESTS=OFF -DOCCUSG_BUILD_BENCHMARKS=OFF -DCATKIN_DEVEL_PREFIX="$root/devel" > /dev/null

work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
sed -nE 's/^ *"file": "(.*)",?$/\1/p' build/tidy/compile_commands.json |
  grep -E "^$root/(build/tidy/occusg_(core|ros)/.*/Unity/|occusg_(core|ros)/)" > "$work/entries"
# The file that stands in for dude in a build without it; clang-tidy takes the command of a neighbour.
echo "$root/occusg_core/src/regions/without_dude.cpp" >> "$work/entries"
sort -u "$work/entries" > "$work/compiled"
git ls-files "${sources[@]}" | sort > "$work/sources"
while read -r file; do
  case $file in
    */Unity/*) sed -nE "s|^#include \"$root/(.*)\"|\1|p" "$file" ;;
    *) echo "${file#"$root/"}" ;;
  esac
done < "$work/compiled" | sort > "$work/read"
if ! cmp -s "$work/sources" "$work/read"; then
  echo "check_tidy.sh: these files are in the repository and not in the build, or the reverse:" >&2
  diff "$work/sources" "$work/read" >&2 || true
  exit 1
fi

# A file of a batch is to clang-tidy a header of it, and a source that is included is suspicious. clang-tidy counts the
# warnings it suppressed in other people's headers; that says nothing here.
xargs -P "$(nproc)" -n 1 clang-tidy --quiet -p build/tidy --checks=-bugprone-suspicious-include \
  --header-filter='occusg_(core|ros)/(include|src|apps)/.*' < "$work/compiled" 2> >(grep -v 'warnings\? generated' >&2)
echo "clang-tidy: no findings in $(wc -l < "$work/sources") files."
