#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds and tests with the oldest versions that are supported and can be had: Debian 11 (OpenCV 4.5, PCL 1.11, CGAL
# 5.2), the compiler of Ubuntu 20.04 (g++ 9) and its CMake (3.16, from PyPI). Needs root and mmdebstrap.
# Usage: scripts/check_oldest_toolchain.sh [--without-ros] [--root FOLDER]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
options=()
folder=
while [ $# -gt 0 ]; do
  case $1 in
    --without-ros) options+=(--without-ros) ;;
    --root) folder=${2:?name a folder}; shift ;;
    *) echo "usage: scripts/check_oldest_toolchain.sh [--without-ros] [--root FOLDER]" >&2; exit 2 ;;
  esac
  shift
done
if [ -z "$folder" ]; then
  folder=$(mktemp -d "${TMPDIR:-/var/tmp}/occusg-oldest.XXXXXX")
  trap 'rm -rf --one-file-system "$folder"' EXIT
fi

"$root/scripts/debian_root.sh" make bullseye "$folder"
git clone --quiet --no-hardlinks --no-local "$root" "$folder/root/occusg"
"$root/scripts/debian_root.sh" run "$folder" root bash -euc '
  cd ~/occusg
  scripts/install_dependencies.sh --for tests '"${options[*]}"'
  DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends g++-9 python3-venv > /dev/null
  /usr/bin/python3 -m venv ~/cmake
  ~/cmake/bin/pip install --quiet "cmake==3.16.*"
  export PATH="$HOME/cmake/bin:$PATH" CXX=g++-9
  cmake --version | head -n 1
  g++-9 --version | head -n 1
  scripts/test.sh --no-install '"${options[*]}"' --without browser --without interchange -DOCCUSG_WARNINGS_AS_ERRORS=ON'
echo "the oldest toolchain builds OccuSG, and the tests pass."
