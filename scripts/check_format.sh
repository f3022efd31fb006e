#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Fails when clang-format would change a C++ file of the project.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
git ls-files '*.hpp' '*.cpp' | xargs clang-format --dry-run -Werror
echo "clang-format: nothing to change."
