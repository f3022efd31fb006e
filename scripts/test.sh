#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds OccuSG and runs every test; ends with ctest's own summary.
# Usage: scripts/test.sh [--no-install]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

install=yes
for argument in "$@"; do
  case $argument in
    --no-install) install=no ;;
    *) echo "usage: scripts/test.sh [--no-install]" >&2; exit 2 ;;
  esac
done

if [ $install = yes ]; then
  "$root/scripts/install_dependencies.sh"
fi
"$root/scripts/build.sh"
cd "$root/build/release"
ctest --output-on-failure -j "$(nproc)"
