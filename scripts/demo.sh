#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# demo.sh BIN OUT [MODEL]: the main job with the real tools. Packs, serves on a free loopback port, lists, fetches two
# regions and then everything, stitches, compares with the original, draws. Stops its server however it ends.
set -euo pipefail

bin=$1
out=$2
model=${3:-}
server_pid=

cleanup() {
  [[ -z $server_pid ]] || kill "$server_pid" 2> /dev/null || true
  [[ -z $server_pid ]] || wait "$server_pid" 2> /dev/null || true
  server_pid=
}
trap cleanup EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

# Shows a command as a user would type it, then runs it.
show() {
  local word line='$'
  for word in "$@"; do
    [[ $word != "$bin"/* ]] || word=${word##*/}
    [[ $word != *[[:space:]]* ]] || word="'$word'"
    line+=" $word"
  done
  printf '%s\n' "$line"
  "$@"
}

# number KEY FILE: the number behind "KEY": in a JSON file of one key a line.
number() {
  sed -n "s/^ *\"$1\": \([0-9.eE+-]*\),\{0,1\}\$/\1/p" "$2" | head -n 1
}

milliseconds() {
  LC_ALL=C awk -v seconds="$1" 'BEGIN { printf "%.1f ms", 1000 * seconds }'
}

start_server() {
  "$bin/selvage-server" --store "$out/store" --listen 127.0.0.1:0 --port-file "$out/port" > "$out/server.log" 2>&1 &
  server_pid=$!
  local tries
  for ((tries = 0; tries < 100; ++tries)); do
    [[ ! -s $out/port ]] || return 0
    kill -0 "$server_pid" 2> /dev/null || break
    sleep 0.1
  done
  cat "$out/server.log" >&2
  echo "demo: the server did not start" >&2
  exit 1
}

rows=()

# demo_model FILE: one model through everything; a row for the table at the end.
demo_model() {
  local file=$1 name address two verdict
  name=$(basename -- "${file%.*}")
  address=127.0.0.1:$(< "$out/port")/$name
  printf '\n== %s ==\n\n' "$name"
  # The default finds parts where a surface bends inwards; a machined part also has them at its sharp edges.
  local mode=xmrg
  [[ $file != "$out/bracket.ply" ]] || mode=cad
  if ! show "$bin/selvage-pack" build "$file" --store "$out/store" --name "$name" --mode "$mode"; then
    echo "demo: no pack could be made of $file, see above" >&2
    exit 1
  fi
  echo
  show "$bin/selvage-client" list "${address%/*}"
  echo
  two=1
  (($("$bin/selvage-client" regions "$address" --json | grep -c '"region":') < 2)) || two=1-2
  show "$bin/selvage-client" get "$address" --regions "$two" -o "$out/$name-part.ply"
  show "$bin/selvage-client" get "$address" -o "$out/$name-whole.ply" --json > "$out/$name.json"
  printf '\n'
  verdict=different
  if show "$bin/selvage-client" compare "$file" "$out/$name-whole.ply"; then verdict=same; fi
  show "$bin/selvage-client" verify "$out/store/$name.selvage"
  show "$bin/selvage-client" draw "$address" -o "$out/$name-regions.png"
  show "$bin/selvage-client" draw "$address" --steps 6 -o "$out/$name-arrival.png"
  show "$bin/selvage-client" draw "$address" --levels -o "$out/$name-levels.png"

  local bytes vertices
  bytes=$(stat --format %s -- "$out/store/$name.selvage")
  vertices=$(number vertices "$out/$name.json")
  rows+=("$(printf '%-16s %8s %10s %10s %8s %12s %12s  %s' "$name" "$(number of_regions "$out/$name.json")" \
    "$(number of_triangles "$out/$name.json")" "$bytes" \
    "$(LC_ALL=C awk -v b="$bytes" -v v="$vertices" 'BEGIN { printf "%.2f", 8 * b / v }')" \
    "$(milliseconds "$(number seconds_to_first_region "$out/$name.json")")" \
    "$(milliseconds "$(number seconds_to_mesh "$out/$name.json")")" "$verdict")")
  [[ $verdict == same ]]
}

rm -rf -- "$out"
mkdir -p -- "$out/store"
models=()
if [[ -n $model ]]; then
  models=("$model")
else
  for sample in waterneck bracket; do
    show "$bin/selvage-pack" sample "$sample" -o "$out/$sample.ply"
    models+=("$out/$sample.ply")
  done
fi
start_server

status=0
for file in "${models[@]}"; do
  demo_model "$file" || status=1
done

printf '\n%-16s %8s %10s %10s %8s %12s %12s  %s\n' model regions triangles bytes bits/vtx 'first region' 'whole model' comparison
printf '%s\n' "${rows[@]}"
printf '\nPictures: the regions in colours, the model as it arrives, region by region, and its levels of detail\n'
for picture in "$out"/*.png; do printf '  %s\n' "$picture"; done
((status == 0)) || echo 'demo: something was lost on the way, see above' >&2
exit "$status"
