#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Follows README on a machine that has never seen the project: makes a minimal Debian system, puts a clean clone of the
# last commit into it and runs the commands of README and docs/ros.md word for word. Needs root and mmdebstrap, and
# 12 GB in the folder it works in.
# Usage: scripts/check_fresh_machine.sh [--release bullseye|bookworm|trixie] [--user root|robot] [--root FOLDER]
#          [--keep] [--without-package NAME] [--then COMMAND]
#   --user robot            as an ordinary user with sudo
#   --root FOLDER           work in FOLDER, which must be empty or absent; a temporary folder is removed at the end
#   --keep                  leave the system in place
#   --without-package NAME  leave NAME out of the lists of packages; the check must then fail and name it
#   --then COMMAND          run COMMAND in the clone at the end, in the same system
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
usage() {
  sed -n 's/^# \{0,1\}//; /^Usage/,/^  --then/p' "${BASH_SOURCE[0]}" >&2
  exit 2
}
release=bookworm
user=root
folder=
keep=no
without=
then=
while [ $# -gt 0 ]; do
  option=$1
  shift
  if [ "$option" = --keep ]; then
    keep=yes
    continue
  fi
  [ $# -gt 0 ] || usage
  case $option in
    --release) release=$1 ;;
    --user) user=$1 ;;
    --root) folder=$1 ;;
    --without-package) without=$1 ;;
    --then) then=$1 ;;
    *) usage ;;
  esac
  shift
done
[[ $release =~ ^(bullseye|bookworm|trixie)$ && $user =~ ^(root|robot)$ ]] || usage
if [ -n "$folder" ] && [ -n "$(ls -A "$folder" 2> /dev/null)" ]; then
  echo "check_fresh_machine.sh: $folder is not empty; the check starts from an empty folder" >&2
  exit 2
fi
folder=${folder:-$(mktemp -d "${TMPDIR:-/var/tmp}/occusg-fresh.XXXXXX")}
cleanup() { if [ $keep = no ]; then rm -rf --one-file-system "$folder"; fi; }
trap cleanup EXIT
if [ -n "$(git -C "$root" status --porcelain)" ]; then
  echo "check_fresh_machine.sh: the work tree has changes that are not committed; the last commit is checked."
fi

step() { printf '\n== %s (%s s)\n' "$1" "$SECONDS"; }
inside() { "$root/scripts/debian_root.sh" run "$folder" "$user" "$@"; }

step "A minimal Debian system: $release"
"$root/scripts/debian_root.sh" make "$release" "$folder"
home=$(chroot "$folder" getent passwd "$user" | cut -d: -f6)
git clone --quiet --no-hardlinks --no-local "$root" "$folder$home/occusg"
if [ -n "$without" ]; then
  grep -rlE "^$without +\|" "$folder$home/occusg/scripts/packages" | xargs -r sed -i -E "/^$without +\|/d"
fi
chroot "$folder" chown -R "$user:$user" "$home/occusg"

step "scripts/demo.sh, README's first command"
inside bash -c 'cd ~/occusg && scripts/demo.sh'
for result in rooms.json scene_graph.json overview.png timing.json; do
  test -s "$folder$home/occusg/out/demo/$result"
done

# The lists that the second command installs from; first, as a package that is missing there may be pulled in by another.
step "Every package that is used is in the lists"
inside bash -c 'cd ~/occusg && scripts/install_dependencies.sh --for tests > /dev/null &&
  /usr/bin/python3 tests/packaging/package_lists_test.py .'

step "scripts/test.sh, README's second command"
inside bash -c 'cd ~/occusg && scripts/test.sh'

step "The other commands of README and docs/ros.md"
inside bash -c 'cd ~/occusg && /usr/bin/python3 scripts/fresh_machine/documented_commands.py'

if [ -n "$then" ]; then
  step "$then"
  inside bash -c "cd ~/occusg && $then"
fi
step "README works on a fresh $release, as $user"
