#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# soak.sh BIN SECONDS: a server under the load of soak.load for so long. Its memory is looked at all the time and must
# not grow after the first fifth by more than a tenth and 8 MiB; no well-behaved client may meet an error; meshes that
# are fetched meanwhile must be those of the files.
set -euo pipefail

bin=$1 seconds=$2
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
work=$(mktemp --directory --tmpdir selvage-soak.XXXXXXXX)
server_pid=
load_pid=
cleanup() {
  local pid
  for pid in $load_pid $server_pid; do kill "$pid" 2> /dev/null || true; done
  wait
  rm -rf -- "$work"
}
trap cleanup EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

mkdir "$work/store"
for model in waterneck bracket; do
  "$bin/selvage-pack" sample $model -o "$work/$model.ply" > /dev/null
  "$bin/selvage-pack" build "$work/$model.ply" --store "$work/store" > /dev/null
done
"$bin/selvage-server" --store "$work/store" --listen 127.0.0.1:0 --port-file "$work/port" 2> "$work/server.log" > /dev/null &
server_pid=$!
for ((tries = 0; tries < 200; ++tries)); do
  [[ ! -s $work/port ]] || break
  sleep 0.05
done
address=127.0.0.1:$(< "$work/port")

{ echo "duration ${seconds}s"; cat "$here/soak.load"; } > "$work/soak.load"
"$bin/selvage-load" "$address" --script "$work/soak.load" > "$work/report" 2> "$work/load.log" &
load_pid=$!

rss_kib() { sed -n 's/^VmRSS:[^0-9]*\([0-9]*\) kB$/\1/p' "/proc/$server_pid/status"; }

begin=$SECONDS base=0 most=0 wrong=0 meshes=0
while kill -0 "$load_pid" 2> /dev/null; do
  kill -0 "$server_pid" 2> /dev/null || { echo 'soak: the server ended' >&2; tail "$work/server.log" >&2; exit 1; }
  now=$(rss_kib)
  if ((SECONDS - begin <= seconds / 5)); then
    ((now <= base)) || base=$now
  else
    ((now <= most)) || most=$now
  fi
  for model in waterneck bracket; do
    "$bin/selvage-client" get "$address/$model" --cache off -o "$work/$model-got.ply" > /dev/null &&
      "$bin/selvage-client" compare "$work/$model.ply" "$work/$model-got.ply" > /dev/null || wrong=$((wrong + 1))
    meshes=$((meshes + 1))
  done
  sleep 1
done
status=0
wait "$load_pid" || status=$?
load_pid=
cat "$work/report"
printf '\nserver: %d KiB at most in the first fifth of %d s, %d KiB after it; %d meshes fetched meanwhile, %d not exact\n' \
  "$base" "$seconds" "$most" "$meshes" "$wrong"
((most <= base + base / 10 + 8192)) || { echo 'soak: the memory of the server grows' >&2; status=1; }
((wrong == 0)) || status=1
exit "$status"
