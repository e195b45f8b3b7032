#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
#
# parts_test.sh SELVAGE_PACK SELVAGE_CLIENT: segmentations and an author's parts on the command line, from file to file.
set -euo pipefail

pack=$1 client=$2 failures=0
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"

fail() { printf '%s\n' "$*"; failures=$((failures + 1)); }

# expects STATUS TEXT COMMAND...: COMMAND ends with STATUS, or any failure if that is "bad", and says TEXT.
expects() {
  local output status=0
  output=$("${@:3}" 2>&1 < /dev/null) || status=$?
  [[ ($1 == bad && $status != 0 || $1 == "$status") && $output == *"$2"* ]] ||
    fail "${*:3}: status $status, expected $1; said: $output"
}

# A strip of squares, two triangles each: four in `left`, two in `right wing`.
cat > strip.obj << 'END'
v 0 0 0
v 1 0 0
v 2 0 0
v 3 0 0
v 0 1 0
v 1 1 0
v 2 1 0
v 3 1 0
g left
f 1 2 6 5
f 2 3 7 6
o right wing
g
f 3 4 8 7
END

expects 0 '2 names' "$pack" build strip.obj --segment-by groups
expects 0 'left: 1' "$client" regions strip.selvage
expects 0 '4 of 6 triangles' "$client" unpack strip.selvage --regions left -o left.ply
expects 0 '2 of 6 triangles' "$client" unpack strip.selvage --regions 'right wing' -o right.ply
expects 0 '6 of 6 triangles' "$client" unpack strip.selvage --regions 'left,right wing' -o both.ply
expects 0 'same' "$client" compare strip.obj both.ply
expects 0 'same' "$client" compare strip.obj strip.selvage
expects 2 "no part is called 'tail'; there are left, right wing" "$client" unpack strip.selvage --regions tail -o x.ply

expects 0 '2 regions, 6 triangles' "$pack" segment --segment-by groups strip.obj -o strip.seg
[[ $(tr '\n' ' ' < strip.seg) == '1 1 1 1 2 2 ' || $(tr '\n' ' ' < strip.seg) == '2 2 2 2 1 1 ' ]] || fail "strip.seg: $(cat strip.seg)"
expects 0 '2 names' "$pack" build strip.obj --segment-by labels strip.seg -o labels.selvage
expects 0 'same' "$client" compare strip.obj labels.selvage
expects 0 '"region_of_triangle"' cat <("$pack" segment strip.obj -o strip.json > /dev/null && cat strip.json)
expects 0 '' "$pack" segment strip.obj -o strip.ply --png strip.png --size 64
expects 0 'same' "$client" compare strip.obj strip.ply
[[ $(head -c 4 strip.png) == $'\x89PNG' ]] || fail 'strip.png is no PNG'
"$pack" sample dumbbell --triangles 2000 -o dumbbell.ply > /dev/null
expects 0 'regions left, saliency' "$pack" segment dumbbell.ply --hierarchy
expects 0 '"merges"' "$pack" segment dumbbell.ply --hierarchy --json
expects 0 '3 regions' "$pack" segment dumbbell.ply --regions 3 -o dumbbell.seg

echo 1 > short.seg
printf '1\n2\nred\n' > red.seg
expects bad '1 labels, but the model has 6 triangles and 8 vertices' "$pack" build strip.obj --segment-by labels short.seg
expects bad "red.seg: line 3: expected a label, which is an integer, found 'red'" \
  "$pack" build strip.obj --segment-by labels red.seg
expects bad 'no such file of labels' "$pack" build strip.obj --segment-by labels none.seg
expects bad 'write shape, groups, components, or labels FILE' "$pack" build strip.obj --segment-by labels
expects bad 'the file names no parts' "$pack" build dumbbell.ply --segment-by groups
expects bad 'neither auto nor a number' "$pack" build strip.obj --regions some
expects bad 'MODEL is required' "$pack" build
((failures == 0))
