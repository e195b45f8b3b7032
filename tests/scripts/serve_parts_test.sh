#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# serve_parts_test.sh SELVAGE_PACK SELVAGE_SERVER SELVAGE_CLIENT: an author's parts by name from a running server, each
# with exactly the triangles that the author gave it.
set -euo pipefail

pack=$1 server=$2 client=$3 failures=0 server_pid=
folder=$(mktemp -d)
cleanup() {
  [[ -z $server_pid ]] || kill "$server_pid" 2> /dev/null || true
  rm -rf -- "$folder"
}
trap cleanup EXIT
cd -- "$folder"
mkdir packs

# expects STATUS TEXT COMMAND...: COMMAND ends with STATUS and says TEXT.
expects() {
  local output status=0
  output=$("${@:3}" 2>&1 < /dev/null) || status=$?
  [[ $1 == "$status" && $output == *"$2"* ]] || {
    printf '%s: status %s, expected %s; said: %s\n' "${*:3}" "$status" "$1" "$output"
    failures=$((failures + 1))
  }
}

# A sheet of 60 x 20 squares. Its middle half is the body; what is left and right of that goes by one name, as do many
# wheels. Above the sheet are twelve bolts, a triangle each.
grid() {
  awk -v want="$1" 'BEGIN {
    for (y = 0; y <= 20; ++y) for (x = 0; x <= 60; ++x) print "v", x, y, (x * y) % 3 / 10
    for (i = 0; i < 12; ++i) { print "v", 3 * i, 25, 0; print "v", 3 * i + 1, 25, 0; print "v", 3 * i, 26, 1 }
    for (y = 0; y < 20; ++y) for (x = 0; x < 60; ++x) {
      part = x < 15 || x >= 45 ? "wheel_left" : "body"
      if (want != "" && part != want) continue
      a = y * 61 + x + 1
      print "g " part
      print "f", a, a + 1, a + 62
      print "f", a, a + 62, a + 61
    }
    for (i = 0; i < 12; ++i) {
      if (want != "" && want != "bolt_" i) continue
      print "g bolt_" i
      print "f", 1282 + 3 * i, 1283 + 3 * i, 1284 + 3 * i
    }
  }'
}

grid '' > car.obj
expects 0 '14 names' "$pack" build car.obj --segment-by groups --max-region 200 --store packs
"$server" --store packs --listen 127.0.0.1:0 --port-file port.txt > server.log 2>&1 &
server_pid=$!
for ((i = 0; i < 200; ++i)); do
  [[ ! -s port.txt ]] || break
  sleep 0.05
done
model=127.0.0.1:$(cat port.txt)/car

for part in wheel_left body bolt_3; do
  grid "$part" > "$part.obj"
  expects 0 '' "$client" get "$model" --regions "$part" -o got.ply
  expects 0 'same' "$client" compare "$part.obj" got.ply
done
{ grid body; grid bolt_11 | grep -v '^v'; } > two.obj
expects 0 '' "$client" get "$model" --regions body,bolt_11 -o got.ply
expects 0 'same' "$client" compare two.obj got.ply
expects 0 '' "$client" get "$model" -o got.ply
expects 0 'same' "$client" compare car.obj got.ply

"$client" regions "$model" > regions.txt
grep -Eq 'wheel_left: .*[-,]' regions.txt || { echo "wheel_left is not several regions: $(cat regions.txt)"; exit 1; }
expects 2 "no part is called 'wheel_lift'; most like it are wheel_left, " "$client" get "$model" --regions wheel_lift -o no.ply
expects 2 "'Bolt_33'; most like it are bolt_3, " "$client" get "$model" --regions Bolt_33 -o no.ply
[[ ! -e no.ply ]] || { echo 'a file was written for a part that is not there'; exit 1; }
((failures == 0))
