#!/bin/sh
# SPDX-License-Identifier: MIT
# compare.sh SOURCE_DIR PRINT_PACK WORK_DIR: the golden packs through the decoder that was written from docs/FORMAT.md
# alone and through ours; 77 means skipped.
set -eu
source=$1 print_pack=$2 work=$3
command -v python3 > /dev/null || { echo 'skipped: no python3'; exit 77; }
set -- "$source"/tests/golden/*.selvage
"$print_pack" "$@" > "$work/ours.txt"
PYTHONDONTWRITEBYTECODE=1 python3 "$source/tests/format/print_pack.py" "$source/common/codec/trained_tables.inc" "$@" > "$work/theirs.txt"
cmp "$work/ours.txt" "$work/theirs.txt"
echo "$(wc -l < "$work/ours.txt") lines alike"
