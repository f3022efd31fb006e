#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Opens a run's scene_graph.dsg.json with spark_dsg from PyPI, in a Python environment of its own.
# Usage: scripts/check_spark_dsg.sh FOLDER   (an output folder of 'occusg run')
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ $# -ne 1 ]; then
  echo "usage: scripts/check_spark_dsg.sh FOLDER" >&2
  exit 2
fi

# Debian's python3 takes no packages from PyPI outside of an environment.
environment=$root/build/python
if [ ! -x "$environment/bin/python" ]; then
  /usr/bin/python3 -m venv "$environment"
fi
if ! "$environment/bin/python" -c 'import spark_dsg' 2> /dev/null; then
  echo "Installing spark-dsg 1.1.3 from PyPI into $environment, to open scene graphs as MIT's tools do."
  "$environment/bin/pip" install --quiet spark-dsg==1.1.3
fi
"$environment/bin/python" "$root/tests/interchange/check_spark_dsg.py" "$1"
