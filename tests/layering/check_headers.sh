#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# check_headers.sh ROOT COMPILER [FLAGS...]: compiles every header under ROOT/{common,server,client,tests} alone, so
# that whoever includes it needs nothing before it. The check_headers target runs it; too slow for every ctest.
set -euo pipefail

export root=${1:?usage: check_headers.sh ROOT COMPILER [FLAGS...]}
shift

compile() {
  "${@:2}" -x c++ -fsyntax-only -I "$root" -include "$1" /dev/null || {
    echo "check_headers: does not compile alone: ${1#"$root"/}" >&2
    return 1
  }
}
export -f compile

folders=()
for folder in common server client tests; do
  [[ ! -d $root/$folder ]] || folders+=("$root/$folder")
done
find "${folders[@]}" -name '*.h' -print0 | sort -z |
  xargs -0 -P "$(nproc)" -I '{}' bash -c 'compile "$@"' _ '{}' "$@"
