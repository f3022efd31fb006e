# SPDX-License-Identifier: BSD-3-Clause
# What the command line's tests share. Sourced by a test that has set $occusg and $work; goes to the
# empty folder $work.
failures=0
rm -rf "$work"
mkdir -p "$work"
cd "$work" || exit 1

fail() {
  echo "FAILED: $1"
  sed 's/^/    /' out.txt err.txt
  failures=$((failures + 1))
}

# expect NAME EXIT_CODE ERROR_TEXT ARGUMENTS...: ERROR_TEXT must be in standard error ('' = nothing there).
expect() {
  local name=$1 code=$2 text=$3
  shift 3
  "$occusg" "$@" > out.txt 2> err.txt < /dev/null
  local got=$?
  [ $got -eq "$code" ] || { fail "$name: exit code $got instead of $code"; return; }
  if [ -z "$text" ]; then
    [ ! -s err.txt ] || fail "$name: unexpected words on standard error"
  else
    grep -qF -- "$text" err.txt || fail "$name: standard error lacks '$text'"
  fi
}

# short_recording NAME FRAMES: the first frames of $recording, its images shared.
short_recording() {
  mkdir -p "$1"
  cp "$recording"/camera.json "$recording"/groundtruth.txt "$1"
  head -n $(($2 + 1)) "$recording/depth.txt" > "$1/depth.txt"
  ln -s "$recording/depth" "$1/depth"
}

finish() {
  if [ $failures -gt 0 ]; then
    echo "$failures failures"
    exit 1
  fi
  echo "all as expected"
}
