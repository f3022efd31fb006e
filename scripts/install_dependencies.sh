#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the Debian or Ubuntu packages OccuSG needs, after saying which and why. The lists are in scripts/packages.
# Usage: scripts/install_dependencies.sh [--for demo|ros|tests|development] [--without-ros]
#   demo          the library and the command
#   ros           also the ROS part (the default)
#   tests         also what the tests need
#   development   also linters and benchmarks
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

usage() {
  echo "usage: scripts/install_dependencies.sh [--for demo|ros|tests|development] [--without-ros]" >&2
  exit 2
}
purpose=ros
with_ros=yes
while [ $# -gt 0 ]; do
  case $1 in
    --for) purpose=${2:-}; shift ;;
    --without-ros) with_ros=no ;;
    *) usage ;;
  esac
  shift || usage
done

# Debian has ROS 1 packages of its own; on Ubuntu 20.04 ROS comes from packages.ros.org.
flavour=debian
# shellcheck disable=SC1091
if [ "$(. /etc/os-release && echo "$ID")" = ubuntu ]; then flavour=noetic; fi
distribution=${ROS_DISTRO:-noetic}

lists=(core)
ros_lists=("ros-$flavour")
case $purpose in
  demo) with_ros=no ;;
  ros) ;;
  tests)
    lists+=(tests)
    ros_lists+=("tests-ros-$flavour")
    ;;
  development)
    lists+=(tests development)
    ros_lists+=("tests-ros-$flavour" "development-ros-$flavour")
    ;;
  *) usage ;;
esac
if [ $with_ros = yes ]; then lists+=("${ros_lists[@]}"); fi

installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2> /dev/null)" = installed ]
}

missing=()
while IFS='|' read -r package reason; do
  package=${package// /}
  case $package in '' | \#*) continue ;; esac
  if [ $flavour = noetic ]; then
    package=${package/#ros-noetic-/ros-$distribution-}
    # Ubuntu's chromium has another name.
    if [ "$package" = chromium ]; then package=chromium-browser; fi
  fi
  if ! installed "$package"; then
    [ ${#missing[@]} -gt 0 ] || echo "These packages will be installed with apt-get:"
    printf '  %-44s for:%s\n' "$package" "$reason"
    missing+=("$package")
  fi
done < <(for list in "${lists[@]}"; do cat "$here/packages/$list.txt"; done)

if [ ${#missing[@]} -eq 0 ]; then
  echo "All needed packages are installed."
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo > /dev/null; then
    echo "install_dependencies.sh: not root and no sudo; ask an administrator to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
"${as_root[@]}" apt-get update -qq
unknown=()
for package in "${missing[@]}"; do
  apt-cache show "$package" > /dev/null 2>&1 || unknown+=("$package")
done
if [ ${#unknown[@]} -gt 0 ]; then
  echo "install_dependencies.sh: apt-get knows no package ${unknown[*]}; on Ubuntu, the sources of" \
    "packages.ros.org are needed for ROS; --without-ros builds without it" >&2
  exit 1
fi
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}" > /dev/null
echo "Installed ${#missing[@]} packages."
