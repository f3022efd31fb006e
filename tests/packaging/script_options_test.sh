#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The scripts of README name a word they do not know, before they install or build anything.
# Usage: script_options_test.sh SCRIPTS
set -uo pipefail
scripts=$1
failures=0

# expect EXIT_CODE TEXT SCRIPT ARGUMENTS...: TEXT is in the one line that the script says.
expect() {
  local code=$1 text=$2 said got=0
  shift 2
  said=$("$scripts/$1" "${@:2}" 2>&1 < /dev/null) || got=$?
  if [ $got -eq "$code" ] && [ "$(wc -l <<< "$said")" -eq 1 ] && [[ $said = *"$text"* ]]; then return; fi
  echo "FAILED: $*: exit code $got"
  echo "$said" | tail -n 3
  failures=$((failures + 1))
}

for script in demo.sh build.sh test.sh; do
  expect 0 "usage: scripts/$script" $script --help
  expect 2 "$script: '--foo' is none of its options" $script --foo
  expect 2 "$script: 'foo' is no" $script foo
done
expect 2 "build.sh: '--foo' is none of its options" build.sh --no-install --foo
expect 2 "'nothing' is none of core cli" test.sh --without nothing
expect 2 "--without needs a group" test.sh --without

if [ $failures -gt 0 ]; then
  echo "$failures failures"
  exit 1
fi
echo "all as expected"
