#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds OccuSG in Release into build/release. Extra arguments go to CMake's configure step.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build="$root/build/release"

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_INSTALL_PREFIX="$root/install" "$@"
cmake --build "$build"
