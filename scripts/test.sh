#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds OccuSG and runs every test. Says how many tests of each group ran, and fails when a group is empty or a test
# was skipped; a group is left out only when it is named.
# Usage: scripts/test.sh [--no-install] [--without-ros] [--without GROUP]... [CMAKE_OPTION...]
#   GROUP: core, cli, ros_unit, rostest, browser, interchange (needs PyPI), packaging
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage="usage: scripts/test.sh [--no-install] [--without-ros] [--without GROUP]... [CMAKE_OPTION...]"
# refuse WHAT: ends with a sentence and the form.
refuse() {
  echo "test.sh: $1; $usage" >&2
  exit 2
}
groups=(core cli ros_unit rostest browser interchange packaging)
left_out=()
flags=()
while [ $# -gt 0 ]; do
  case $1 in
    --no-install) flags+=(--no-install) ;;
    --without-ros)
      flags+=(--without-ros)
      left_out+=(ros_unit rostest)
      ;;
    --without)
      [ $# -gt 1 ] || refuse "--without needs a group, one of ${groups[*]}"
      [[ " ${groups[*]} " = *" $2 "* ]] || refuse "--without: '$2' is none of ${groups[*]}"
      left_out+=("$2")
      shift
      ;;
    -h | --help) echo "$usage"; exit 0 ;;
    --*) refuse "'$1' is none of its options, nor one of CMake's such as -DNAME=VALUE" ;;
    -?*) break ;;
    *) refuse "'$1' is no option" ;;
  esac
  shift
done

"$root/scripts/build.sh" "${flags[@]}" --tests "$@"
# shellcheck source=scripts/environment.sh
. "$root/scripts/environment.sh"
cd "$root/build/release"

exclude='^$'
if [ ${#left_out[@]} -gt 0 ]; then exclude="^($(IFS='|' && echo "${left_out[*]}"))\$"; fi
log=$PWD/test.log
status=0
ctest --output-on-failure -j "$(nproc)" -LE "$exclude" 2>&1 | tee "$log" || status=$?

ctest --show-only=json-v1 > "$PWD/tests.json"
/usr/bin/python3 "$root/scripts/test_groups.py" "$PWD/tests.json" "$log" "${groups[@]}" -- "${left_out[@]}" || status=1
exit $status
