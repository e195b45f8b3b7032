#!/bin/sh
# SPDX-License-Identifier: MIT
# compare.sh SOURCE_DIR NATIVE_PROGRAM WORK_DIR: decodes the fuzz corpora natively and as WebAssembly; 77 means skipped.
set -eu
source=$1 native=$2 work=$3
skip() { echo "skipped: $1 (packages: clang-14 lld-14 libc++-14-dev-wasm32 libc++abi-14-dev-wasm32 libclang-rt-14-dev-wasm32 wasi-libc nodejs)"; exit 77; }
command -v clang++-14 > /dev/null || skip "no clang++-14"
command -v node > /dev/null || skip "no node"
echo '#include <vector>
int main() { return static_cast<int>(std::vector<int>(1)[0]); }' > "$work/probe.cpp"
clang++-14 --target=wasm32-wasi -fno-exceptions "$work/probe.cpp" -o "$work/probe.wasm" 2> /dev/null || skip "no WASI C++ library"

cd "$source"
clang++-14 --target=wasm32-wasi -O1 -std=c++20 -fno-exceptions -ffp-contract=off -I. -idirafter /usr/include \
  $(cat tests/wasm/decoder_sources.txt) -o "$work/decode_parts.wasm"
set -- "$source"/tests/fuzz/corpus/fuzz_region/* "$source"/tests/fuzz/corpus/fuzz_bundle/*
"$native" "$@" > "$work/native.txt"
node --no-warnings tests/wasm/run_wasi.mjs "$work/decode_parts.wasm" "$@" > "$work/wasm.txt"
cmp "$work/native.txt" "$work/wasm.txt"
echo "$(wc -l < "$work/native.txt") parts decode alike"
