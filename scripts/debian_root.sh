#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes a minimal Debian system in a folder, from the host's own package source, with git, sudo and the ordinary user
# 'robot', and runs commands in it. Needs root and mmdebstrap.
# Usage: scripts/debian_root.sh make RELEASE FOLDER    RELEASE: bullseye, bookworm, trixie
#        scripts/debian_root.sh run FOLDER USER COMMAND...
set -euo pipefail

usage() {
  echo "usage: scripts/debian_root.sh make RELEASE FOLDER | run FOLDER USER COMMAND..." >&2
  exit 2
}

# The first Debian mirror the host's apt uses.
mirror() {
  apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 2> /dev/null | grep -m 1 '/debian/\?$' || true
}

make_root() {
  local release=$1 folder=$2 source options=() setting
  if [ "$(id -u)" -ne 0 ] || ! command -v mmdebstrap > /dev/null; then
    echo "debian_root.sh: making a root needs root and the package mmdebstrap" >&2
    exit 1
  fi
  source=$(mirror)
  source=${source:-http://deb.debian.org/debian}
  # A proxy, and a mirror that lags behind, are the host's affair.
  while read -r setting; do
    options+=("--aptopt=$setting")
  done < <(apt-config dump | grep -E '^Acquire::(http|https)::Proxy|^Acquire::Check-(Valid-Until|Date)')
  # The system is thrown away: nobody waits until each file of a package is safe on the disk.
  mmdebstrap --quiet --variant=apt --dpkgopt=force-unsafe-io --include=ca-certificates,git,passwd,sudo "${options[@]}" \
    "$release" "$folder" "deb $source $release main"
  # Registries behind a certificate of the host's own are reached with the host's certificates.
  if [ -s /etc/ssl/certs/ca-certificates.crt ]; then
    cp /etc/ssl/certs/ca-certificates.crt "$folder/etc/ssl/certs/ca-certificates.crt"
  fi
  printf '127.0.0.1 localhost %s\n' "$(hostname)" > "$folder/etc/hosts"
  chroot "$folder" useradd --create-home --shell /bin/bash robot
  echo 'robot ALL=(ALL) NOPASSWD: ALL' > "$folder/etc/sudoers.d/robot"
}

# The processes and mounts of a run end with it.
run_in_root() {
  local folder=$1 user=$2 home
  shift 2
  home=$(chroot "$folder" getent passwd "$user" | cut -d: -f6)
  cp --remove-destination /etc/resolv.conf "$folder/etc/resolv.conf"
  # shellcheck disable=SC2016
  exec unshare --mount --pid --fork --kill-child bash -c '
    folder=$1 user=$2 home=$3
    shift 3
    mount --make-rprivate /
    mount -t proc proc "$folder/proc"
    mount --rbind /dev "$folder/dev"
    mount -t sysfs sysfs "$folder/sys"
    mount -t tmpfs -o mode=1777 tmpfs "$folder/dev/shm"
    kept=()
    for name in CI PIP_INDEX_URL PIP_CERT SSL_CERT_FILE REQUESTS_CA_BUNDLE http_proxy https_proxy no_proxy; do
      if [ -n "${!name:-}" ]; then kept+=("$name=${!name}"); fi
    done
    exec chroot --userspec="$user" --groups="$user" "$folder" /usr/bin/env -i HOME="$home" USER="$user" TERM=dumb \
      LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "${kept[@]}" "$@"
  ' run "$folder" "$user" "$home" "$@"
}

case ${1:-} in
  make) [ $# -eq 3 ] || usage; make_root "$2" "$3" ;;
  run) [ $# -ge 4 ] || usage; shift; run_in_root "$@" ;;
  *) usage ;;
esac
