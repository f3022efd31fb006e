#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# What every change must pass beside README's commands, after scripts/test.sh: format, warnings, static analysis,
# sanitizers. Usage: scripts/ci_checks.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
step() { printf '\n== %s (%s s)\n' "$1" "$SECONDS"; }

step "Format and package"
scripts/install_dependencies.sh --for development
scripts/check_format.sh
PATH=/usr/bin:$PATH catkin_lint --quiet .

step "No warning in the builds of README's commands"
if grep -E 'warning:' build/demo.log build/build.log; then
  echo "ci_checks.sh: the build has warnings" >&2
  exit 1
fi

step "The site"
scripts/build_docs.sh --no-install

step "A build without the decomposer dude, and so without CGAL's packages under the GPL"
scripts/check_without_dude.sh | tail -n 3

step "Sanitizers over the core"
cmake --preset sanitize > /dev/null
cmake --build --preset sanitize
ctest --preset sanitize -j "$(nproc)" | tail -n 30

step "Static analysis"
scripts/check_tidy.sh
step "All checks passed"
