#!/bin/sh
# SPDX-License-Identifier: MIT
# compare.sh SOURCE_DIR WORK_DIR NATIVE_PROGRAM few|all: builds the decoders in several ways and decodes the fuzz corpora, which
# hold the golden packs' parts; all must print what the native program does; 77 means skipped. -U__SSE2__ takes our own vector
# code away, the -fno-... ones the compiler's.
set -eu
source=$1 work=$2 native=$3 builds=$4
cd "$source"
launcher=$(command -v ccache || true)
clang=$(command -v clang++-14 || command -v clang++) || { echo "skipped: no clang (package clang-14)"; exit 77; }

# build_and_run NAME COMPILER FLAGS...
build_and_run() {
  name=$1 compiler=$2
  shift 2
  objects=$work/$name.objects
  rm -rf "$objects"
  mkdir -p "$objects"
  for file in $(cat tests/wasm/decoder_sources.txt); do
    $launcher "$compiler" -std=c++20 -ffp-contract=off -I. "$@" -c "$file" -o "$objects/$(echo "$file" | tr / -).o"
  done
  "$compiler" "$objects"/*.o -o "$work/$name"
  "$work/$name" tests/fuzz/corpus/fuzz_region/* tests/fuzz/corpus/fuzz_bundle/* > "$work/$name.txt"
  cmp "$work/native.txt" "$work/$name.txt"
  echo "$name: $(wc -l < "$work/$name.txt") parts"
}

"$native" tests/fuzz/corpus/fuzz_region/* tests/fuzz/corpus/fuzz_bundle/* > "$work/native.txt"
build_and_run clang-O3 "$clang" -O3
build_and_run clang-O3-scalar "$clang" -O3 -fno-vectorize -fno-slp-vectorize -U__SSE2__
test "$builds" = all || exit 0
build_and_run clang-O0 "$clang" -O0
build_and_run clang-O3-avx2 "$clang" -O3 -mavx2 -mbmi2
build_and_run gcc-O2 g++ -O2
build_and_run gcc-O0-scalar g++ -O0 -U__SSE2__
