#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# runtime_packages.sh PROGRAM...: the Debian packages whose shared libraries the programs load, one a line. So the
# image that runs selvage needs no second list of packages beside packages.txt.
set -euo pipefail

# A library may be registered with or without /usr in front, wherever the loader says that it found it.
package_of() {
  local path
  path=$(readlink -f -- "$1")
  dpkg-query --search "$path" 2> /dev/null || dpkg-query --search "${path#/usr}" 2> /dev/null ||
    dpkg-query --search "/usr$path"
}

for program in "$@"; do
  ldd "$program"
done | while read -r _ arrow path _; do
  [[ $arrow == '=>' ]] || continue
  [[ $path == /* ]] || { echo "runtime_packages: a library is missing" >&2; exit 1; }
  package_of "$path"
done | cut -d: -f1 | sort -u
