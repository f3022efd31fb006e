#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs clang-tidy over the sources; needs a configured build folder.
# Usage: scripts/check_tidy.sh [BUILD_FOLDER]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:-build/release}
# clang-tidy counts the warnings it suppressed in other people's headers; that says nothing here.
sources=('occusg_core/*.cpp')
if grep -q '/occusg_ros/src/' "$build/compile_commands.json"; then
  sources+=('occusg_ros/*.cpp')
fi
git ls-files "${sources[@]}" |
  xargs -P "$(nproc)" -n 1 clang-tidy --quiet -p "$build" 2> >(grep -v 'warnings\? generated' >&2)
echo "clang-tidy: no findings."
