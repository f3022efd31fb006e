#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the site: README, the documents and the reference of the public headers. Fails when a link leads nowhere, or a
# public class, enumeration, type or free function says nothing of itself. Members whose names say all need no sentence.
# Usage: scripts/build_docs.sh [--no-install] [FOLDER]   FOLDER: where it goes; build/docs when not given
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
install=yes
if [ "${1:-}" = --no-install ]; then install=no; shift; fi
if [ $# -gt 1 ] || [[ "${1:-}" == -* ]]; then
  echo "usage: scripts/build_docs.sh [--no-install] [FOLDER]" >&2
  exit 2
fi
if [ $install = yes ]; then "$root/scripts/install_dependencies.sh" --for development; fi
out=${1:-$root/build/docs}
mkdir -p "$out"
out=$(cd "$out" && pwd)
cd "$root"
(cat docs/Doxyfile; echo "OUTPUT_DIRECTORY = \"$out\"") | doxygen - > "$out/doxygen.log" 2>&1 || {
  tail -n 20 "$out/doxygen.log" >&2
  echo "build_docs.sh: doxygen failed" >&2
  exit 1
}

must_be_documented='Compound|\(typedef\)|\(enumeration\)|of (file|namespace) '
problems=$(grep warning "$out/doxygen.log" | grep -vE 'is not documented' || true)
undocumented=$(grep 'is not documented' "$out/doxygen.log" | grep -E "$must_be_documented" || true)
if [ -n "$problems$undocumented" ]; then
  printf '%s\n' "$problems" "$undocumented" >&2
  echo "build_docs.sh: the lines above say what is missing" >&2
  exit 1
fi
/usr/bin/python3 tests/packaging/doc_links_test.py "$root"
[ -s "$out/html/index.html" ] || { echo "build_docs.sh: there is no page" >&2; exit 1; }
echo "The site: $out/html/index.html"
