#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What is built is hardened (docs/reliability.md): position independent, read-only relocations bound at the start,
# stack protection, fortified functions, and libraries are never looked for in the current folder.
# Usage: hardening_test.sh BUILD_TYPE WORK_FOLDER BINARY...
set -uo pipefail
build_type=$1
work=$2
shift 2
failures=0
fail() {
  echo "FAILED: $1"
  failures=$((failures + 1))
}

for binary in "$@"; do
  dynamic=$(readelf -W -d "$binary")
  runpath=$(sed -n 's/.*(RU\?N\?R\?PATH).*\[\(.*\)\]/\1/p' <<< "$dynamic")
  # Every place must be absolute or start at the file itself; an empty one is the current folder.
  if [ -n "$runpath" ]; then
    while read -r -d: place; do
      [[ $place = /* || $place = '$ORIGIN'* ]] || fail "$binary looks for libraries in '$place' ($runpath)"
    done <<< "$runpath:"
  fi
  [ "$build_type" = Release ] || continue
  grep -q 'Type: *DYN' <<< "$(readelf -W -h "$binary")" || fail "$binary is not position independent"
  grep -qE 'BIND_NOW|Flags:.* NOW' <<< "$dynamic" || fail "$binary is not bound at the start"
  grep -q GNU_RELRO <<< "$(readelf -W -l "$binary")" || fail "$binary has no read-only relocations"
  # A program that is a line around a library has no array to protect.
  case $binary in
    */occusg | *.so)
      symbols=$(readelf -W --dyn-syms "$binary")
      grep -q __stack_chk_fail <<< "$symbols" || fail "$binary has no stack protection"
      grep -qE '__[a-z]+_chk' <<< "$symbols" || fail "$binary has no fortified function"
      ;;
  esac
done

# A library in the current folder that is named like one of ours must not be loaded.
rm -rf "$work"
mkdir -p "$work"
cd "$work" || exit 1
echo '__attribute__((constructor)) void run(void) { extern int puts(const char*); puts("LOADED"); }' > evil.c
cc -shared -fPIC -o evil.so evil.c || fail "the library cannot be made"
for library in $(ldd "$1" | sed -n 's/^\s*\(lib[^ ]*\) => .*/\1/p'); do cp evil.so "$library"; done
! "$1" --version 2>&1 | grep -q LOADED || fail "$1 loads a library from the current folder"

[ $failures -eq 0 ] || exit 1
echo "$# binaries are hardened"
