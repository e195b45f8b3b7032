#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# What ./run says to those who call it wrongly, from any directory.
set -euo pipefail

run=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../../run
failures=0
cd /

# expects STATUS TEXT ARGS...: run ARGS ends with STATUS and says TEXT.
expects() {
  local output status=0
  output=$("$run" "${@:3}" 2>&1 < /dev/null) || status=$?
  [[ $status == "$1" && $output == *"$2"* ]] || {
    printf 'run %s: status %s, expected %s; said: %s\n' "${*:3}" "$status" "$1" "$output"
    failures=$((failures + 1))
  }
}

expects 0 'usage: ./run COMMAND'
expects 0 'usage: ./run COMMAND' help
expects 0 'usage: ./run COMMAND' --help
expects 2 'unknown command: tset' tset
expects 1 'sanitize knows asan and tsan, not msan' sanitize msan
expects 1 'corpus needs a folder' corpus
expects 1 'no such folder: /does/not/exist' corpus /does/not/exist
((failures == 0))
