#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# install_packages.sh [LIST...]: installs the Debian packages of packages.txt, and of further lists, that this machine
# does not have yet; nothing else, and without touching the network when there are none. The one way in which ./run,
# docker/Dockerfile and CI set up a machine.
# Needs only what a bare Debian has: bash, coreutils, dpkg, apt; root or sudo if something is missing.
set -euo pipefail

root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd -P)

die() {
  printf 'setup: %s\n' "$*" >&2
  exit 1
}

lists=("$root/packages.txt" "$@")

# One name a line, without comments and blanks.
listed_packages() {
  local list line
  for list in "${lists[@]}"; do
    while IFS= read -r line || [[ -n $line ]]; do
      line=${line%%#*}
      line=${line//[[:space:]]/}
      [[ -z $line ]] || printf '%s\n' "$line"
    done < "$list"
  done
}

is_installed() {
  [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2> /dev/null) == installed ]]
}

# Sets `become_root` to the command prefix that makes us root.
find_root() {
  become_root=()
  if ((EUID != 0)); then
    command -v sudo > /dev/null ||
      die "not root and no sudo here. As root, run: apt-get install --no-install-recommends ${missing[*]}"
    become_root=(sudo)
  fi
}

for list in "${lists[@]}"; do
  [[ -r $list ]] || die "$list cannot be read"
done
mapfile -t packages < <(listed_packages)
((${#packages[@]} > 0)) || die "${lists[*]} names no package"

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
  die "this is not a Debian system, so packages cannot be installed for you. Selvage is built on Debian 12;
install what these Debian packages hold by your system's own means: ${packages[*]}
then set SELVAGE_SETUP=skip and run ./run again."
fi

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  exit 0
fi

find_root
printf 'setup: installing %d missing packages: %s\n' "${#missing[@]}" "${missing[*]}"
# Waits for another apt (an automatic update, say) to finish rather than failing on its lock.
apt=("${become_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 -qq)
"${apt[@]}" update || die "apt-get update failed: see above. Is the network reachable?"
"${apt[@]}" install --yes --no-install-recommends "${missing[@]}" ||
  die "apt-get install failed: see above. The names are those of Debian 12 (bookworm)."
