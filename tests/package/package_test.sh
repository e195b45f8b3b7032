#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# package_test.sh BUILD EXAMPLE PACK SERVER COMPILER FLAGS: installs the client library of BUILD into a temporary
# prefix, builds the example against it there, and lets it fetch from a server.
set -euo pipefail

build=$1 example=$2 pack=$3 server=$4 compiler=$5 flags=$6
work=$(mktemp --directory --tmpdir selvage-package.XXXXXXXX)
server_pid=
cleanup() {
  [[ -z $server_pid ]] || kill "$server_pid" 2> /dev/null || true
  rm -rf -- "$work"
}
trap cleanup EXIT

die() {
  printf 'package_test: %s\n' "$*" >&2
  exit 1
}

cmake --install "$build" --prefix "$work/prefix" --component client > "$work/install.log"
! grep -rlE '#include "(common|client)/' "$work/prefix/include" || die "a header includes what was not installed"
! grep -rlE 'boost/|\.pb\.h|openssl/|curl/' "$work/prefix/include" || die "a public header shows what we are made of"

cmake -S "$example" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="$flags -Wall -Wextra -Werror" > "$work/configure.log" || { cat "$work/configure.log" >&2; exit 1; }
cmake --build "$work/build" > "$work/build.log" || { cat "$work/build.log" >&2; exit 1; }

# Every public header alone.
while IFS= read -r header; do
  # shellcheck disable=SC2086
  "$compiler" $flags -std=c++20 -fsyntax-only -x c++ -I "$work/prefix/include" "$header" ||
    die "does not compile alone: $header"
done < <(find "$work/prefix/include/selvage/client/fetch" -name '*.h')

"$pack" sample waterneck -o "$work/waterneck.ply" > /dev/null
mkdir "$work/store"
"$pack" build "$work/waterneck.ply" --store "$work/store" > /dev/null
"$server" --store "$work/store" --listen 127.0.0.1:0 --port-file "$work/port" 2> "$work/server.log" > /dev/null &
server_pid=$!
for ((tries = 0; tries < 200; ++tries)); do
  [[ ! -s $work/port ]] || break
  kill -0 "$server_pid" 2> /dev/null || die "the server ended: $(< "$work/server.log")"
  sleep 0.05
done

output=$("$work/build/fetch_regions" "127.0.0.1:$(< "$work/port")/waterneck" 1,3-4)
printf '%s\n' "$output"
for expected in 'region 1:' 'region 3:' 'region 4:' 'stitched:' 'done: 3 regions'; do
  [[ $output == *"$expected"* ]] || die "the example does not say '$expected'"
done
! "$work/build/fetch_regions" "127.0.0.1:$(< "$work/port")/nothing" 1 2> "$work/error" || die "no error for a model that is not there"
grep -q nothing "$work/error" || die "an error without the name"
