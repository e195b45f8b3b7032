#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# check_layering.sh ROOT: checks every #include under ROOT/{common,server,client} against the rules below and prints
# each violation as file:line: include (why). Exit code 1 if there is any.
#
# The rules keep the picture true that docs/ARCHITECTURE.md draws: server and client meet only in common; serving
# is lookup and send, so a session knows bytes and never meshes; the core is pure, so that it can be fuzzed, run in
# parallel, and ported; a costly or replaceable library has one door. Tests and benchmarks may see everything.
set -euo pipefail

cd -- "${1:?usage: check_layering.sh ROOT}"

# All includes as "file:line:#include ...". No include at all would mean that we look in the wrong place.
includes=$(grep -rnE '^[[:space:]]*#[[:space:]]*include' --include='*.h' --include='*.cpp' common server client 2> /dev/null || true)
[[ -n $includes ]] || { echo "check_layering: no includes under $PWD" >&2; exit 1; }
violations=0

report() {
  local why=$1 line
  while IFS= read -r line; do
    [[ -n $line ]] || continue
    printf '%s  (%s)\n' "$line" "$why"
    violations=$((violations + 1))
  done
}

# forbid WHERE WHAT WHY: no file whose path starts with WHERE includes WHAT. All are extended regular expressions,
# WHAT from the character after the opening bracket or quote.
forbid() {
  report "$3" <<< "$(grep -E "^($1)[^:]*:[0-9]+:" <<< "$includes" | grep -E "include[[:space:]]*[<\"]($2)" || true)"
}

# only_in WHERE WHAT WHY: files elsewhere do not include WHAT.
only_in() {
  report "$3" <<< "$(grep -vE "^($1)[^:]*:[0-9]+:" <<< "$includes" | grep -E "include[[:space:]]*[<\"]($2)" || true)"
}

pure='common/(coding|mesh|codec)/|server/(segment|simplify|encode)/|client/(decode|stitch)/'

forbid 'server/' 'client/' 'server and client never include each other'
forbid 'client/' 'server/' 'server and client never include each other'
forbid 'common/' '(server|client)/' 'common knows neither server nor client'
forbid 'server/session/' '(server/(encode|segment|simplify|ingest)|common/(mesh|codec|mesh_io))/' \
  'a session serves bytes, not meshes'

forbid "$pure" '[^">]*/[^">]*>' 'the core uses the standard library only'
# A compiler's vector intrinsics are no library; what uses them gives the same result without.
forbid "$pure" '[^">/]*\.(h|hh|hpp)"' 'the core uses the standard library only'
forbid "$pure" '([^e">/]|e[^m">/])[^">/]*\.(h|hh|hpp)>' 'the core uses the standard library only'
forbid "$pure" 'common/(net|mesh_io|render)/|common/base/log\.h' 'the core has no input, output, or log'
# client/stitch may lock: parts arrive there from several decoding threads.
forbid "${pure/(decode|stitch)/decode}" '(thread|mutex|shared_mutex|atomic|future|condition_variable|chrono|filesystem|[io]?fstream|iostream|ctime)>' \
  'pure code has no threads, files, or clocks'

only_in 'common/mesh_io/|client/interop/' 'OpenMesh/' 'OpenMesh has two doors'
only_in 'common/net/|(server|client)/(session|app)/|client/load/|server/operate/' '(boost/)?asio' 'Asio stays in net, sessions, load, operate and app'
only_in 'common/net/|server/operate/' 'boost/(beast|system)' 'Asio stays in net, session and app'
only_in 'server/operate/' 'prometheus/' 'metrics have one door'
only_in 'server/app/' 'toml\+\+/' 'configuration is an app matter'
only_in 'common/net/(messages|publish_messages|message_fields)\.cpp' 'google/protobuf|[^">]*\.pb\.h' 'protobuf stays behind common/net/messages.h'
only_in 'common/base/log\.cpp' 'spdlog/' 'spdlog stays behind common/base/log.h'
only_in 'common/base/(parallel|task_group)\.cpp' '(tbb|oneapi)/' 'threads come from common/base/parallel.h and task_group.h'
only_in 'common/(base|net)/' 'openssl/' 'OpenSSL serves hashing and TLS only'
only_in 'client/http/' 'curl/' 'libcurl stays behind client/http/range_client.h'
only_in '(common|server|client)/app/' 'CLI/' 'command lines are an app matter'

forbid '' '[^">/.]*\.h"' 'includes name files from the repository root'

if ((violations > 0)); then
  printf '%d violations of the layering\n' "$violations" >&2
  exit 1
fi
printf '%d includes keep to the layering\n' "$(wc -l <<< "$includes")"
