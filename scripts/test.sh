#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds OccuSG and runs every test; ends with ctest's own summary.
# Usage: scripts/test.sh [--no-install] [--warnings-as-errors]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

install=yes
warnings_as_errors=OFF
for argument in "$@"; do
  case $argument in
    --no-install) install=no ;;
    --warnings-as-errors) warnings_as_errors=ON ;;
    *) echo "usage: scripts/test.sh [--no-install] [--warnings-as-errors]" >&2; exit 2 ;;
  esac
done

if [ $install = yes ]; then
  "$root/scripts/install_dependencies.sh"
fi
"$root/scripts/build.sh" -DOCCUSG_WARNINGS_AS_ERRORS=$warnings_as_errors
cd "$root/build/release"
ctest --output-on-failure -j "$(nproc)"
